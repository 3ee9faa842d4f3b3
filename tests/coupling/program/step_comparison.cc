// diptych: tests of the step study on synthetic histories
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>
#include <fstream>

#include <nlohmann/json.hpp>

#include "coupling/program/step_comparison.h"
#include "discrete/files/table_file.h"
#include "tests/files.h"

namespace
{
  using namespace diptych::coupling;
  using diptych::discrete::LoadingVariable;

  // A loading to 4 % in n rows with the stress ratio 0.3 and the work 10 x strain. Friction takes 8 of it and impacts 1.
  HistoryTable history(const int n)
  {
    HistoryTable table;
    for (int k = 1; k <= n; ++k)
      {
        const double strain = 0.04 * k / n;
        table["time"].push_back(100 * strain), table["progress"].push_back(strain);
        table["stress_ratio"].push_back(0.3), table["external_work"].push_back(10 * strain);
        table["friction_dissipation"].push_back(8 * strain), table["impact_dissipation"].push_back(1 * strain);
        table["kinetic_energy"].push_back(0.01), table["max_penetration"].push_back(1e-3);
      }
    return table;
  }

  std::vector<StepRun> three_runs()
  {
    return {{0.1, history(100)}, {0.05, history(200)}, {0.025, history(400)}};
  }

  void scale(StepRun &run, const std::string &name, const double factor)
  {
    for (double &value : run.history[name])
      value *= factor;
  }

  const StepComparison::Quantity &quantity(const StepComparison &comparison, const std::string &name)
  {
    for (const StepComparison::Quantity &q : comparison.quantities)
      if (q.name == name)
        return q;
    throw std::runtime_error("no quantity " + name);
  }

  HistoryTable table_of(const std::string &csv)
  {
    const diptych::discrete::WordTable words = diptych::discrete::read_words(csv);
    HistoryTable                       table;
    for (const auto &row : words.rows)
      for (std::size_t c = 0; c < words.columns.size(); ++c)
        table[words.columns[c]].push_back(std::stod(row[c]));
    return table;
  }

  StepComparison compared(const std::vector<StepRun> &runs,
                          const LoadingVariable       loading_variable = LoadingVariable::axial_strain,
                          const double                window           = 0.005)
  {
    return compare_steps(runs, window, loading_variable);
  }

  void expect_says(const StepComparison &comparison, const std::string &words)
  {
    diptych::tests::expect_words(comparison.verdict, {words});
  }

  // Straight lines are the same for rows at other strains.
  TEST(StepComparison, EqualRunsDoNotDifferForRowsAtOtherStrains)
  {
    const StepComparison c = compared(three_runs());
    EXPECT_LT(c.largest, 1e-12);
    expect_says(c, "the step does not matter");
    ASSERT_EQ(c.quantities.size(), 4u);
    for (const StepComparison::Quantity &q : c.quantities)
      {
        ASSERT_EQ(q.largest_difference.size(), 3u);
        EXPECT_EQ(q.largest_difference.back(), 0) << q.name;
      }
  }

  // 10 % of 0.4 at the end, where the finest run has its largest value, 0.4.
  TEST(StepComparison, TenPerCentMoreWorkMattersAndIsReportedWithItsStrain)
  {
    std::vector<StepRun> runs = three_runs();
    scale(runs[0], "external_work", 1.1);
    scale(runs[1], "external_work", 0.96);
    const StepComparison c = compared(runs);
    EXPECT_NEAR(c.largest, 0.1, 1e-9);
    EXPECT_NEAR(quantity(c, "external_work").largest_difference[1], 0.04, 1e-9);
    EXPECT_NEAR(quantity(c, "external_work").at_progress, 0.04, 1e-9);
    EXPECT_LT(quantity(c, "friction_dissipation").largest_difference[0], 1e-12);
    expect_says(c, "step 0.1 against 0.025: the step matters");
    expect_says(c, "10 % (external_work, at 4 % axial strain");
  }

  // A triangular bump of dissipation about 2 %, 1 % wide and 0.1 high. The reported strain is that of its top.
  TEST(StepComparison, FindsTheStrainOfTheLargestDifference)
  {
    std::vector<StepRun> runs = three_runs();
    for (std::size_t k = 0; k < 100; ++k)
      {
        const double strain = runs[0].history["progress"][k];
        runs[0].history["impact_dissipation"][k] += 0.1 * std::max(0., 1 - std::abs(strain - 0.02) / 0.005);
      }
    const StepComparison c = compared(runs);
    EXPECT_NEAR(quantity(c, "impact_dissipation").at_progress, 0.02, 2e-4);
    EXPECT_NEAR(c.largest, 0.1 / 0.4, 0.01); // dissipations are relative to the work
    expect_says(c, "impact_dissipation, at 2");
  }

  // Stress ratios that jump by +-30 % from row to row have equal means over windows of many rows. 0.5 % are 12 rows, of which
  // half a row at the ends may remain, at most 0.3/12/2 of 1.
  TEST(StepComparison, SingleStepsMayScatter)
  {
    std::vector<StepRun> runs = three_runs();
    for (std::size_t k = 0; k < 100; ++k)
      runs[0].history["stress_ratio"][k] *= k % 2 ? 1.3 : 0.7;
    const StepComparison c = compared(runs);
    EXPECT_LT(c.largest, 0.3 / 12);
    expect_says(c, "does not matter");
    // Without the mean they would fail: a window of one row shows the scatter.
    EXPECT_GT(compared(runs, LoadingVariable::axial_strain, 0.0004).largest, 0.1);
  }

  // A lasting shift is not scatter.
  TEST(StepComparison, AShiftedStressRatioMatters)
  {
    std::vector<StepRun> runs = three_runs();
    scale(runs[0], "stress_ratio", 1.06);
    const StepComparison c = compared(runs);
    EXPECT_NEAR(c.largest, 0.06, 1e-9);
    expect_says(c, "matters, largest difference 6 % (stress_ratio");
  }

  // The verdict names the loading variable.
  TEST(StepComparison, ShearIsComparedAlongItsTravel)
  {
    std::vector<StepRun> runs = three_runs();
    for (double &work : runs[0].history["external_work"])
      work *= work > 0.2 ? 2 : 1; // the first half is unchanged
    const StepComparison c = compared(runs, LoadingVariable::shear_strain);
    expect_says(c, "the step matters");
    expect_says(c, "% shear strain");
    EXPECT_NEAR(quantity(c, "external_work").largest_difference[0], 1, 1e-6);
    expect_says(compared(runs, LoadingVariable::time), "at time 0.0");
  }

  TEST(StepComparison, RejectsASingleRun)
  {
    EXPECT_THROW((void)compared({{0.1, history(10)}}), std::invalid_argument);
  }

  TEST(StepComparison, FilesHoldEveryRowAndTheVerdict)
  {
    const diptych::tests::Folder folder;
    const std::vector<StepRun>   runs = three_runs();
    const StepComparison         c    = compared(runs);
    write_step_comparison(folder.path, runs, c);
    const HistoryTable table = table_of(folder / "study_step.csv");
    EXPECT_EQ(column(table, "step").size(), 700u);
    EXPECT_EQ(column(table, "step").front(), 0.1);
    EXPECT_EQ(column(table, "step").back(), 0.025);
    EXPECT_NEAR(column(table, "external_work").back(), 0.4, 1e-9);
    const nlohmann::json root = nlohmann::json::parse(std::ifstream(folder / "study_step.json"));
    EXPECT_EQ(root["verdict"], c.verdict);
    EXPECT_EQ(root["steps"], (std::vector<double>{0.1, 0.05, 0.025}));
    EXPECT_EQ(root["quantities"].size(), 4u);
    EXPECT_EQ(root["margin"], 0.05);
  }
} // namespace
