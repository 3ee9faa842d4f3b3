// diptych: statistics over members: means, intervals, lines, equivalence, numbers of comparisons
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "coupling/cells/principal_axes.h"
#include "coupling/ensembles/ensemble.h"
#include "coupling/statistics/equivalence.h"
#include "coupling/ensembles/seed_list.h"

namespace
{
  using namespace diptych::coupling;
  using nlohmann::json;

  // Quantiles of Student's distribution with 3 degrees of freedom, from printed tables: 0.975 and 0.95.
  constexpr double t_975 = 3.18245, t_95 = 2.35336, table_accuracy = 5e-6;

  // 1, 2, 3, 4: mean 2.5, sum of squared deviations 2.25 + 0.25 + 0.25 + 2.25 = 5, deviation sqrt(5/3). The standard error of
  // the mean is half of that.
  const std::vector<double> four           = {1, 2, 3, 4};
  const double              four_deviation = std::sqrt(5. / 3);

  TEST(Equivalence, StudentIntervalOfFourValues)
  {
    const SampleStatistics s = statistics(four);
    EXPECT_EQ(s.n, 4);
    EXPECT_DOUBLE_EQ(s.mean, 2.5);
    EXPECT_DOUBLE_EQ(s.deviation, four_deviation);
    EXPECT_NEAR(s.low, 2.5 - t_975 * four_deviation / 2, table_accuracy);
    EXPECT_NEAR(s.high, 2.5 + t_975 * four_deviation / 2, table_accuracy);
  }

  TEST(Equivalence, OneValueHasAMeanAndNoInterval)
  {
    const SampleStatistics one = statistics({3}), none = statistics({});
    EXPECT_EQ(one.mean, 3);
    EXPECT_TRUE(std::isnan(one.deviation) && std::isnan(one.low) && std::isnan(one.high));
    EXPECT_EQ(none.n, 0);
    EXPECT_TRUE(std::isnan(none.mean));
  }

  // Lines at 85, -85 and 90 degrees lie within 5 degrees of the vertical; as plain numbers their mean is 30.
  TEST(Equivalence, LinesAcrossTheVerticalHaveAVerticalMean)
  {
    const SampleStatistics s = line_statistics({85, -85, 90});
    EXPECT_NEAR(std::abs(s.mean), 90, 1e-12);
    EXPECT_NEAR(s.deviation, 5, 1e-12); // turns -5, 5, 0: sqrt(50 / 2)
    EXPECT_LT(s.low, s.mean);
    EXPECT_LT(s.mean, s.high);
  }

  TEST(Equivalence, LinesAwayFromTheVerticalHaveTheMeanOfTheNumbers)
  {
    const SampleStatistics lines = line_statistics({-43, -45, -47}), plain = statistics({-43, -45, -47});
    EXPECT_NEAR(lines.mean, plain.mean, 1e-12);
    EXPECT_NEAR(lines.low, plain.low, 1e-12);
    EXPECT_NEAR(lines.high, plain.high, 1e-12);
  }

  TEST(Equivalence, LinesAtRightAnglesHaveNoMean)
  {
    EXPECT_TRUE(std::isnan(line_statistics({10, -80}).mean));
    EXPECT_EQ(line_turn(80, -80), -20);
    EXPECT_EQ(line_turn(45, -45), 90);
  }

  // The 90 % interval of 1, 2, 3, 4 ends at 2.5 + 2.35336 x 0.645497 = 4.01909.
  TEST(Equivalence, MarginsJustBeyondTheNinetyPercentIntervalAreEquivalence)
  {
    const double edge = 2.5 + t_95 * four_deviation / 2;
    EXPECT_EQ(compare_differences(four, edge + 1e-4).verdict, Verdict::equivalent);
    EXPECT_EQ(compare_differences(four, edge - 1e-4).verdict, Verdict::cannot_tell);
    const std::vector<double> mirrored = {-1, -2, -3, -4};
    EXPECT_EQ(compare_differences(mirrored, edge + 1e-4).verdict, Verdict::equivalent);
    EXPECT_EQ(compare_differences(mirrored, edge - 1e-4).verdict, Verdict::cannot_tell);
    EXPECT_NEAR(compare_differences(four, 1).difference_90.high, edge, table_accuracy);
  }

  // The 95 % interval of 1, 2, 3, 4 begins at 2.5 - 3.18245 x 0.645497 = 0.44574.
  TEST(Equivalence, MarginsJustBelowTheNinetyFivePercentIntervalAreADifference)
  {
    const double edge = 2.5 - t_975 * four_deviation / 2;
    EXPECT_EQ(compare_differences(four, edge - 1e-4).verdict, Verdict::different);
    EXPECT_EQ(compare_differences(four, edge + 1e-4).verdict, Verdict::cannot_tell);
    EXPECT_EQ(compare_differences({-1, -2, -3, -4}, edge - 1e-4).verdict, Verdict::different);
  }

  TEST(Equivalence, OnePairIsNotEnough)
  {
    EXPECT_EQ(compare_differences({0}, 3).verdict, Verdict::cannot_tell);
    EXPECT_EQ(compare_relative({10}, {10}, 3).verdict, Verdict::cannot_tell);
    EXPECT_NEAR(compare_relative({10}, {12}, 3).difference.value, 0.2, 1e-15);
    EXPECT_EQ(compare_differences({}, 3).n, 0);
    EXPECT_EQ(compare_relative({}, {}, 3).n, 0);
  }

  TEST(Equivalence, TurnsAcrossTheVerticalAreSmall)
  {
    const Equivalence e = compare_turns({line_turn(-89, 89), line_turn(89, -89), line_turn(90, 90), line_turn(-89.5, 90)}, 3);
    EXPECT_EQ(e.verdict, Verdict::equivalent); // turns 2, -2, 0, 0.5
    EXPECT_NEAR(e.difference.value, 0.125, 1e-3);
  }

  // Grains without scatter: the ratio is the continuum's mean over a constant, its interval Student's.
  TEST(Equivalence, RelativeDifferencesFromAConstantHaveStudentsInterval)
  {
    const Equivalence e = compare_relative({10, 10, 10, 10}, {11, 12, 13, 14}, 0.2);
    EXPECT_NEAR(e.difference.value, 0.25, 1e-15);
    EXPECT_NEAR(e.difference.low, 0.25 - t_975 * four_deviation / 20, table_accuracy);
    EXPECT_NEAR(e.difference_90.high, 0.25 + t_95 * four_deviation / 20, table_accuracy);
  }

  // If the continuum follows the grains sample by sample, the grains' scatter does not widen the interval. Near a double root
  // its ends have an error of the square root of the rounding error.
  TEST(Equivalence, ScatterSharedByBothPanelsCancels)
  {
    const Equivalence e = compare_relative({5, 10, 20, 8}, {5.5, 11, 22, 8.8}, 0.2);
    EXPECT_NEAR(e.difference.low, 0.1, 1e-6);
    EXPECT_NEAR(e.difference.high, 0.1, 1e-6);
    EXPECT_EQ(e.verdict, Verdict::equivalent);
    EXPECT_EQ(compare_relative({5, 10, 20, 8}, {5.5, 11, 22, 8.8}, 0.09).verdict, Verdict::different);
  }

  // At the end q of the 90 % interval, Student's t of continuum - (1 + q) grains is its 95 % quantile: the one-sided test at 5
  // %.
  TEST(Equivalence, EndsOfTheRelativeIntervalAreThoseOfTheOneSidedTests)
  {
    const std::vector<double> grains = {18, 15, 22, 11}, continuum = {18, 18, 18.5, 18};
    const Equivalence         e = compare_relative(grains, continuum, 0.2);
    for (const double end : {e.difference_90.low, e.difference_90.high})
      {
        std::vector<double> combined;
        for (std::size_t k = 0; k < grains.size(); ++k)
          combined.push_back(continuum[k] - (1 + end) * grains[k]);
        const SampleStatistics s = statistics(combined);
        EXPECT_NEAR(std::abs(s.mean) / (s.deviation / 2), t_95, table_accuracy);
      }
    EXPECT_LT(e.difference_90.low, e.difference.value);
    EXPECT_GT(e.difference_90.high, e.difference.value);
    EXPECT_EQ(e.verdict, Verdict::cannot_tell);
  }

  // Mean 0.25, deviation 1.71: |t| = 0.29, far below 3.18.
  TEST(Equivalence, NothingIsRelativeToAMeanThatMayBeZero)
  {
    const Equivalence e = compare_relative({-2, 2, 0, 1}, {1, 1, 1, 1}, 100);
    EXPECT_TRUE(std::isnan(e.difference.low) && std::isnan(e.difference.high));
    EXPECT_EQ(e.verdict, Verdict::cannot_tell);
    EXPECT_THROW((void)compare_relative({1, 2}, {1}, 0.2), std::invalid_argument);
  }

  TEST(SeedList, RangesAndSinglesGiveAscendingSeeds)
  {
    EXPECT_EQ(read_seeds("1-4"), (std::vector<int>{1, 2, 3, 4}));
    EXPECT_EQ(read_seeds("5-7,1,3"), (std::vector<int>{1, 3, 5, 6, 7}));
    EXPECT_EQ(read_seeds("2147483646-2147483647").size(), 2u);
    EXPECT_EQ(read_seeds("0-9999").size(), 10000u);
  }

  TEST(SeedList, InvalidListsAreRefused)
  {
    for (const char *text : {"", ",", "1,", "1-", "-3", "one", "1.5", "1 2", "8-1", "1,1", "1-3,2", "0-10000", "2147483648",
                             "99999999999999999999", "1--2", "1-2-3"})
      try
        {
          read_seeds(text);
          ADD_FAILURE() << "'" << text << "' was read";
        }
      catch (const std::invalid_argument &error)
        {
          EXPECT_NE(std::string(error.what()).find("--seeds"), std::string::npos);
        }
  }

  json band(const double angle, const double width)
  {
    return {{"angle_deg", {{"value", angle}, {"low", angle - 1}, {"high", nullptr}}},
            {"width_10_90_d", width},
            {"offset_d", -2.},
            {"jump", angle < 0 ? 0.8 : -0.8}};
  }

  json panel(const std::vector<json> &bands)
  {
    return {{"stress_ratio", 0.3}, {"bands", bands}, {"strips", {{"angle_deg", 12}}}};
  }

  // A comparison with one stage and one window, as the program writes it.
  json comparison(const int seed, const std::vector<json> &grains_bands, const std::vector<json> &continuum_bands)
  {
    json discrete      = panel(grains_bands);
    discrete["probes"] = json::array({{{"name", "zone"},
                                       {"t_over_s", {{"value", 0.4}}},
                                       {"interval", {{"low", 1}, {"high", 2}}},
                                       {"s1", 2},
                                       {"polygon", {{0, 0}, {1, 1}}}}});
    const json stage   = {
        {"progress", 0.04 * (1 + 1e-9 * seed)},
        {"axial_strain", 0.04},
        {"discrete", discrete},
        {"continuum", panel(continuum_bands)},
        {"difference",
         {{"angle_deg", 3}, {"offset_d", nullptr}, {"stress", json::array({{{"label", "6 d"}, {"relative_l2", 0.2}}})}}}};
    const json window = {{"from", 0.}, {"to", 0.04}, {"discrete", panel(grains_bands)}, {"continuum", panel(continuum_bands)}};
    return {{"seed", seed},
            {"stages", json::array({stage})},
            {"windows", json::array({window})},
            {"cost", {{"discrete_cpu_s", 1.5 * seed}}},
            {"discrete_summary", {{"peak_stress_ratio", 0.36 + 0.001 * seed}, {"ns_per_update", seed}, {"message", "finished"}}},
            {"continuum_summary", {{"peak_stress_ratio", 0.36}, {"finished", true}}}};
  }

  const Quantity &quantity(const Ensemble &ensemble, const std::string &name)
  {
    for (const Quantity &q : ensemble.quantities)
      if (q.name == name)
        return q;
    throw std::runtime_error(name + " is missing");
  }

  bool has(const Ensemble &ensemble, const std::string &name)
  {
    for (const Quantity &q : ensemble.quantities)
      if (q.name == name)
        return true;
    return false;
  }

  const PanelVerdict &verdict(const Ensemble &ensemble, const std::string &name)
  {
    for (const PanelVerdict &v : ensemble.verdicts)
      if (v.quantity == name)
        return v;
    throw std::runtime_error(name + " is missing");
  }

  std::vector<int> counts(const Ensemble &ensemble, const std::string &name)
  {
    for (const BandCount &count : ensemble.bands)
      if (count.name == name)
        return {count.members, count.members + 3};
    throw std::runtime_error(name + " is missing");
  }

  Ensemble ensemble_of(const std::vector<json> &comparisons, const bool folded = false)
  {
    std::vector<Member> members;
    for (const json &one : comparisons)
      {
        members.push_back(member_of(one));
        if (folded)
          fold(members.back());
      }
    return evaluate(members, {});
  }

  TEST(Ensemble, NumbersAreFoundByTheirPlaceWithOrWithoutAnInterval)
  {
    const Ensemble e = ensemble_of({comparison(1, {band(-44, 18)}, {}), comparison(2, {band(-46, 20)}, {})});
    EXPECT_EQ(e.seeds, (std::vector<int>{1, 2}));
    EXPECT_EQ(quantity(e, "stage 0.04 discrete stress_ratio").statistics.n, 2); // stages that differ by rounding are one
    EXPECT_NEAR(quantity(e, "window 0-0.04 discrete band angle_deg").statistics.mean, -45, 1e-12);
    EXPECT_EQ(quantity(e, "window 0-0.04 discrete band angle_deg").unit, "degrees");
    EXPECT_EQ(quantity(e, "stage 0.04 discrete probe zone t_over_s").statistics.mean, 0.4);
    EXPECT_EQ(quantity(e, "stage 0.04 discrete probe zone s1").unit, "pressure");
    EXPECT_EQ(quantity(e, "stage 0.04 difference stress 6 d relative_l2").statistics.mean, 0.2);
    EXPECT_NEAR(quantity(e, "discrete_summary peak_stress_ratio").statistics.mean, 0.3615, 1e-12);
  }

  TEST(Ensemble, MeasuredTimesAndListsAreLeftOut)
  {
    const Ensemble e = ensemble_of({comparison(1, {}, {})});
    for (const Quantity &q : e.quantities)
      for (const char *word :
           {"cpu", "ns_per_update", "message", "finished", "strips", "polygon", "axial_strain", "offset_d", "interval"})
        EXPECT_EQ(q.name.find(word), std::string::npos) << q.name;
  }

  TEST(Ensemble, OnlyMembersWithABandCountForIt)
  {
    const Ensemble  e     = ensemble_of({comparison(1, {band(-44, 18), band(40, 9)}, {band(-45, 18)}),
                                         comparison(2, {}, {band(-45, 18)}), comparison(3, {band(-46, 22)}, {band(-45, 18)})});
    const Quantity &width = quantity(e, "window 0-0.04 discrete band width_10_90_d");
    EXPECT_EQ(width.statistics.n, 2);
    EXPECT_EQ(width.statistics.mean, 20); // the strongest band is the first of the list
    EXPECT_TRUE(std::isnan(width.values[1]));
    EXPECT_EQ(verdict(e, "peak_stress_ratio").equivalence.n, 3);
    EXPECT_EQ(verdict(e, "final_volumetric_strain").equivalence.n, 0); // the files have none
    EXPECT_EQ(verdict(e, "window 0-0.04 band width_10_90_d").equivalence.n, 2);
    EXPECT_EQ(counts(e, "window 0-0.04 discrete"), (std::vector<int>{1, 1, 1}));
    EXPECT_EQ(counts(e, "window 0-0.04 continuum"), (std::vector<int>{0, 3, 0}));
  }

  // Chance decides between left and right. Bands at 55 and -55 degrees are the same kind of band, and their jumps get the same
  // sign.
  TEST(Ensemble, MirrorImagesOfABandAreFoldedTogether)
  {
    const std::vector<json> comparisons = {comparison(1, {band(55, 10)}, {band(-54, 10)}),
                                           comparison(2, {band(-53, 10)}, {band(54, 10)})};
    const Ensemble          e           = ensemble_of(comparisons, true);
    EXPECT_NEAR(quantity(e, "window 0-0.04 discrete band angle_deg").statistics.mean, 54, 1e-12);
    EXPECT_EQ(quantity(e, "window 0-0.04 discrete band offset_d").values, (std::vector<double>{2, 2}));
    EXPECT_EQ(quantity(e, "window 0-0.04 discrete band jump").values, (std::vector<double>{-0.8, -0.8}));
    EXPECT_FALSE(has(e, "stage 0.04 difference angle_deg"));
    EXPECT_TRUE(has(ensemble_of(comparisons), "stage 0.04 difference angle_deg"));
    // 54 - 55 and 54 - 53
    EXPECT_NEAR(verdict(e, "window 0-0.04 band angle_deg").equivalence.difference.value, 0, 1e-12);
  }

  TEST(Ensemble, OnlyAVerticalDescentIsItsOwnMirrorImage)
  {
    Scene scene;
    EXPECT_FALSE(is_mirror_symmetric(scene)); // 45 degrees
    scene.loading.horizontal_over_vertical = 0;
    EXPECT_TRUE(is_mirror_symmetric(scene));
    scene.discrete.time.gravity_x = 0.1;
    EXPECT_FALSE(is_mirror_symmetric(scene));
    scene.discrete.time.gravity_x = 0;
    scene.discrete.drives.left_x  = "velocity 1";
    EXPECT_FALSE(is_mirror_symmetric(scene));
    scene.discrete.drives.left_x = "auto";
    scene.loading.mode           = diptych::discrete::LoadingMode::shear;
    EXPECT_FALSE(is_mirror_symmetric(scene));
  }

  TEST(Ensemble, AFileThatIsNotAComparisonIsRefused)
  {
    EXPECT_THROW((void)member_of(json::object()), std::invalid_argument);
    EXPECT_THROW((void)member_of({{"seed", 1}, {"windows", json::array({{{"from", 0}}})}}), std::invalid_argument);
  }
} // namespace
