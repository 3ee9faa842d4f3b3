// diptych: plans of panels with known errors
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "coupling/plans/continuum_plan.h"
#include "coupling/plans/grain_choice.h"
#include "coupling/plans/grains_plan.h"
#include "coupling/plans/plan_question.h"

namespace
{
  namespace continuum = diptych::continuum;
  using namespace diptych::coupling;

  // The last value of a key, or `otherwise`.
  double value_of(const PilotTask &task, const std::string &key, const double otherwise)
  {
    double value = otherwise;
    for (const Settings *settings : {&task.common, &task.points.front()})
      for (const Entry &entry : *settings)
        if (entry.section + "/" + entry.key == key)
          value = std::stod(entry.value);
    return value;
  }

  bool has(const PilotTask &task, const std::string &key, const std::string &value)
  {
    std::string last;
    for (const Settings *settings : {&task.common, &task.points.front()})
      for (const Entry &entry : *settings)
        if (entry.section + "/" + entry.key == key)
          last = entry.value;
    return last == value;
  }

  double planned_value(const PanelPlan &plan, const std::string &key)
  {
    double value = NAN;
    for (const Entry &entry : plan.settings)
      if (entry.section + "/" + entry.key == key)
        value = std::stod(entry.value);
    return value;
  }

  PlanQuestion question(const double accuracy)
  {
    PlanQuestion q;
    q.accuracy = accuracy;
    StudyQuantity strength;
    strength.name = "strength";
    q.grains      = {{strength, StepError::strength}};
    q.continuum   = {{strength, StepError::strength}};
    return q;
  }

  // Grains whose strength errs by `factor` times the rule's expectation. Samples scatter; the cost is proportional to
  // 1/accuracy.
  struct Grains
  {
    double factor = 1, scatter = 0.04, noise = 0.01;
    int    runs = 0;

    std::vector<PilotPoint> run(const PilotTask &task)
    {
      const double accuracy = value_of(task, "discrete/accuracy", NAN);
      PilotPoint   point;
      point.values.resize(1);
      for (const int seed : task.seeds.empty() ? std::vector<int>{1} : task.seeds)
        {
          std::mt19937 of_sample(static_cast<unsigned>(seed)), of_run(static_cast<unsigned>(seed + 1e6 * accuracy));
          std::normal_distribution<double> normal, normal_of_run; // each stores a second value
          const double                     sample = scatter * normal(of_sample), chaos = noise * normal_of_run(of_run);
          point.values[0].push_back(0.3 * (1 + sample) * (1 + chaos + factor * accuracy));
          ++runs;
        }
      point.cpu_s          = 0.05 / accuracy;
      point.strength_error = accuracy, point.dilation_error = 1.25 * accuracy;
      return {point};
    }
  };

  PanelPlan plan_with(Grains &grains, const double accuracy, const Scene &scene = {})
  {
    return plan_grains(question(accuracy), scene, [&](const PilotTask &task) { return grains.run(task); });
  }

  TEST(GrainsPlan, MethodAndSamplesTogetherKeepToTheAccuracy)
  {
    for (const double accuracy : {0.02, 0.05, 0.1})
      {
        Grains          grains;
        const PanelPlan plan = plan_with(grains, accuracy);
        ASSERT_TRUE(plan.reaches);
        const QuantityBudget &budget = plan.quantities.front();
        EXPECT_LE(budget.total(), accuracy * (1 + 1e-12));
        EXPECT_GT(budget.total(), 0.5 * accuracy) << "the plan must use more than half of the accuracy";
        // Within a factor of two of the truth.
        const double truth = planned_value(plan, "discrete/accuracy");
        EXPECT_GT(budget.parts.front().error, truth / 2);
        EXPECT_LT(budget.parts.front().error, truth * 2);
        EXPECT_NEAR(plan.cpu_s, 0.05 / truth, 0.01 * plan.cpu_s);
        EXPECT_EQ(plan.seeds.front(), 1);
      }
  }

  TEST(GrainsPlan, AWrongRuleIsDetectedAndCostsMore)
  {
    Grains          usual, worse{6, 0.04, 0.002};
    const PanelPlan a = plan_with(usual, 0.03), b = plan_with(worse, 0.03);
    ASSERT_TRUE(b.reaches);
    EXPECT_LT(planned_value(b, "discrete/accuracy"), planned_value(a, "discrete/accuracy"));
    const double truth = 6 * planned_value(b, "discrete/accuracy"), said = b.quantities.front().parts.front().error;
    EXPECT_GT(said, truth / 2);
    EXPECT_LT(said, truth * 2);
  }

  TEST(GrainsPlan, OneSampleFromAFileHasTheVariationOfOneRunInsteadOfScatter)
  {
    Scene scene;
    scene.sample.file = "sample.h5";
    Grains          quiet{1, 0.04, 0.001}, noisy{1, 0.04, 0.05};
    const PanelPlan plan = plan_with(quiet, 0.03, scene);
    EXPECT_TRUE(plan.reaches);
    EXPECT_EQ(plan.n_samples(), 1);
    EXPECT_TRUE(std::isnan(plan.quantities.front().scatter));
    EXPECT_LE(planned_value(plan, "discrete/accuracy"), 0.03);
    EXPECT_EQ(plan.quantities.front().parts.back().cause, "one run");
    EXPECT_FALSE(plan_with(noisy, 0.03, scene).reaches) << "one run lies 5 % from the mean of runs";
  }

  TEST(GrainsPlan, UnreachableAccuraciesAreReported)
  {
    Grains wild{1, 300};
    EXPECT_FALSE(plan_with(wild, 0.001).reaches);
    const PanelPlan failed = plan_grains(question(0.02), Scene(), [](const PilotTask &) {
      PilotPoint point;
      point.words = "no room";
      return std::vector<PilotPoint>{point};
    });
    EXPECT_FALSE(failed.reaches);
    EXPECT_NE(failed.decisions.back().find("no room"), std::string::npos);
  }

  TEST(GrainsPlan, TheChoiceIsTheCheapestOfAll)
  {
    const std::vector<GrainErrors> errors = {{{1, 0.2}, 0.03, true}, {{1.5, 0.5}, 0.02, true}};
    const std::vector<CostPoint>   cost   = {{0.05, 1}, {0.025, 1.6}};
    const GrainChoice              choice = cheapest_choice(errors, cost, 0.04, 0);
    ASSERT_GT(choice.samples, 0);
    const auto total = [&](const double accuracy) {
      int n = 1;
      for (const GrainErrors &one : errors)
        {
          const int needed = samples_for(one.scatter, 0.04 - one.at(accuracy));
          n                = needed == 0 ? 1000000 : std::max(n, needed);
        }
      return n * cost_at(cost, accuracy);
    };
    for (double accuracy = 0.05; accuracy > 0.001; accuracy *= 0.9)
      EXPECT_GT(total(accuracy), 0.85 * total(choice.accuracy)) << accuracy; // the grid has four points per octave
    EXPECT_EQ(cheapest_choice(errors, cost, 0.0001, 0).samples, 0);
  }

  // A continuum whose strength errs with the square of its element size and linearly with its load step.
  struct Elements
  {
    double of_elements = 0.002, of_steps = 2, of_law = 0;
    bool   is_local = false;

    std::vector<PilotPoint> run(const PilotTask &task) const
    {
      const double h = value_of(task, "continuum/element_size", 1), step = value_of(task, "continuum/max_step", 0.01),
                   tolerance = value_of(task, "continuum/tolerance", 1e-5);
      const bool local       = is_local && !has(task, "continuum/law", "cosserat_mohr_coulomb");
      PilotPoint point;
      point.values = {{0.4 * (1 + (local ? 0.05 * std::log2(h) : of_elements * h * h)) * (1 + of_steps * step) *
                       (1 + 0.1 * tolerance) * (has(task, "continuum/law", "mohr_coulomb") ? 1 + of_law : 1)}};
      point.cpu_s  = 1 / (h * h);
      if (has(task, "continuum/law", "mohr_coulomb"))
        point.cpu_s /= 2;
      return {point};
    }
  };

  Scene rectangle(const continuum::LawKind law)
  {
    Scene scene;
    scene.continuum.mesh.kind                = diptych::continuum::MeshOption::Kind::rectangle;
    scene.continuum.rectangle_width          = 60;
    scene.continuum.rectangle_height         = 80;
    scene.continuum.law                      = law;
    scene.continuum.geometry                 = diptych::continuum::Kinematics::small_strain;
    scene.continuum.material.internal_length = 2;
    return scene;
  }

  PanelPlan plan_with(const Elements &elements, const double accuracy, const Scene &scene)
  {
    return plan_continuum(question(accuracy), scene, [&](const PilotTask &task) { return elements.run(task); });
  }

  TEST(ContinuumPlan, EveryKnobIsAsCoarseAsItsShareAllows)
  {
    const Elements  elements{0.002, 2, 0.03};
    const PanelPlan plan = plan_with(elements, 0.02, rectangle(diptych::continuum::LawKind::cosserat_mohr_coulomb));
    ASSERT_TRUE(plan.reaches);
    const double h = planned_value(plan, "continuum/element_size"), step = planned_value(plan, "continuum/max_step");
    const double truth = elements.of_elements * h * h + elements.of_steps * step;
    EXPECT_LT(truth, 0.02);
    EXPECT_GT(plan.quantities.front().total(), truth / 2);
    EXPECT_LT(plan.quantities.front().total(), truth * 2);
    EXPECT_GT(h, 1) << "elements of 2 d err by 0.8 %, which is allowed";
    EXPECT_EQ(planned_value(plan, "continuum/tolerance"), 1e-3);
    EXPECT_EQ(plan.n_samples(), 1);
  }

  TEST(ContinuumPlan, AnInternalLengthIsKeptWhereItMatters)
  {
    const Scene scene  = rectangle(diptych::continuum::LawKind::cosserat_mohr_coulomb);
    const auto  is_set = [](const PanelPlan &plan) {
      for (const Entry &entry : plan.settings)
        if (entry.key == "law")
          return true;
      return false;
    };
    EXPECT_TRUE(is_set(plan_with({0.002, 2, 0.001}, 0.02, scene))) << "a law without one is as good and costs half";
    EXPECT_FALSE(is_set(plan_with({0.002, 2, 0.03}, 0.02, scene)));
  }

  TEST(ContinuumPlan, AMeshDependentLawIsReplacedAndReported)
  {
    Elements local;
    local.is_local       = true;
    const PanelPlan plan = plan_with(local, 0.02, rectangle(diptych::continuum::LawKind::mohr_coulomb));
    EXPECT_TRUE(plan.reaches);
    std::string all;
    for (const std::string &decision : plan.decisions)
      all += decision + "\n";
    EXPECT_NE(all.find("used instead: cosserat_mohr_coulomb"), std::string::npos) << all;
  }

  TEST(ContinuumPlan, ASizeWithoutEffectIsNotConvergence)
  {
    // Load steps above 0.002 have no effect, so the first three values are equal and contain no information.
    const auto run = [](PilotTask task) {
      const double step = std::min(0.002, value_of(task, "continuum/max_step", 0.01));
      task.points.front().push_back(planned("continuum", "max_step", step));
      return Elements{0.0001, 20}.run(task);
    };
    const PanelPlan plan = plan_continuum(question(0.02), rectangle(diptych::continuum::LawKind::drucker_prager), run);
    EXPECT_LT(planned_value(plan, "continuum/max_step"), 0.0005) << "20 x the step is to stay below a fifth of 2 %";
  }

  TEST(PlanQuestion, AccuraciesAreSharesOrPerCents)
  {
    EXPECT_DOUBLE_EQ(read_accuracy("2 %"), 0.02);
    EXPECT_DOUBLE_EQ(read_accuracy("2%"), 0.02);
    EXPECT_DOUBLE_EQ(read_accuracy("0.02"), 0.02);
    for (const char *wrong : {"2", "", "%", "two", "0.02 x", "0.0001", "60 %", "nan", "-1 %"})
      EXPECT_THROW(read_accuracy(wrong), SceneError) << wrong;
  }
} // namespace
