// diptych: step = auto, and runs with long steps
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/stepping/step_rule.h"
#include "tests/discrete/small_scenes.h"

namespace
{
  using namespace diptych::tests;

  // Two discs of density 4 and diameter 2 = d at rest between platens at rest, under the stress s = 9. The unit of time is d
  // sqrt(rho/s) = 4/3.
  struct RuleScene
  {
    State       state;
    StepSetting setting = exact_setting(1);

    AccuracyOptions accuracy;

    RuleScene()
    {
      state.walls = {{{0, 0}, {0, 1}}, {{0, 4}, {0, -1}}};
      add_grain(state.grains, {0, 1}, 1, 4.);
      add_grain(state.grains, {3, 1}, 1, 4.);
      setting.mean_diameter = 2;
      accuracy.tolerance    = 1e-4;
    }
    StepChoice choose(const double stress, const double rate) const
    {
      return choose_step(state, setting, {stress, rate, accuracy});
    }
    double tolerance(const double stress, const double rate) const
    {
      return choose_tolerance(state, setting, {stress, rate, accuracy});
    }
  };

  TEST(StepRule, PressedGrainsAreBoundByTheForces)
  {
    RuleScene s;
    EXPECT_EQ(s.choose(9, 0).bound, "forces");
    EXPECT_NEAR(s.choose(9, 0).step, 5 * 4. / 3, 1e-14);
    s.setting.lateral  = EndGrains{}; // accelerated inward: 1 instead of 5, and the pressure counts even without contacts
    s.setting.pressure = 9;
    EXPECT_NEAR(s.choose(9, 0).step, 4. / 3, 1e-14);
    EXPECT_NEAR(s.choose(0, 0).step, 4. / 3, 1e-14);
    EXPECT_NEAR(s.choose(36, 0).step, 2. / 3, 1e-14) << "a stress above the pressure counts";
  }

  // The estimate of a run before there are grains is the choice of the rule for grains at rest.
  TEST(StepRule, ASampleAtRestHasItsStepBeforeThereAreGrains)
  {
    RuleScene    s;
    const double unit = 4. / 3; // 2 sqrt(4/9)
    for (const double rate : {0., 1e-9, 1e-5, 1e-3, 0.1})
      {
        const StepChoice expected = step_at_rest({2, unit, false}, {9, rate, s.accuracy});
        EXPECT_EQ(expected.bound, s.choose(9, rate).bound) << rate;
        EXPECT_NEAR(expected.step / s.choose(9, rate).step, 1, 1e-14) << rate;
      }
  }

  TEST(StepRule, FlyingGrainsAndFastWallsAreBoundByTheMotion)
  {
    RuleScene s;
    s.state.grains.velocity[0] = {4, 0}; // root mean square sqrt(16/2), three times that: 8.485
    EXPECT_EQ(s.choose(9, 0).bound, "motion");
    EXPECT_NEAR(s.choose(9, 0).step, 0.2 / (3 * std::sqrt(8.)), 1e-14);
    s.state.walls[1].velocity = {6, 8};
    EXPECT_NEAR(s.choose(9, 0).step, 0.02, 1e-14);
    EXPECT_NEAR(s.choose(0, 0).step, 0.02, 1e-14) << "also without pressure";
  }

  TEST(StepRule, FallingGrainsAreBoundByGravity)
  {
    RuleScene s;
    s.setting.stepping.gravity_x = 3, s.setting.stepping.gravity_y = -4;
    EXPECT_EQ(s.choose(0, 0).bound, "gravity");
    EXPECT_NEAR(s.choose(0, 0).step, 0.3 * std::sqrt(0.4), 1e-14);
  }

  // With times in units of d sqrt(rho/s) = 4/3: (0.2 + 0.8 h) tolerance h / I = 1.25 accuracy.
  TEST(StepRule, SlowLoadingIsBoundByTheSolversNoise)
  {
    RuleScene    s;
    const double unit = 4. / 3, number = 1e-5 * unit;
    const auto   loss = [&](const double step) {
      return (0.2 + 0.8 * step / unit) * s.accuracy.tolerance.value() * step / unit / number;
    };
    EXPECT_EQ(s.choose(9, 1e-5).bound, "solver");
    EXPECT_NEAR(loss(s.choose(9, 1e-5).step), 1.25 * 0.02, 1e-14);
    s.accuracy.tolerance = 1e-7;
    EXPECT_EQ(s.choose(9, 1e-5).bound, "strength") << "a tighter solve allows longer steps";
  }

  TEST(StepRule, TheErrorOfTheStrengthBoundsLongSteps)
  {
    RuleScene s;
    s.accuracy.tolerance.reset();
    EXPECT_EQ(s.choose(9, 1e-3).bound, "strength");
    EXPECT_NEAR(s.choose(9, 1e-3).step, 4. / 3 / 9, 1e-14) << "order 1/2: (0.02 / 0.06)^2 d sqrt(rho/s)";
    s.accuracy.accuracy = 0.01;
    EXPECT_NEAR(s.choose(9, 1e-3).step, 4. / 3 / 36, 1e-14) << "half the error, a quarter of the step";
    EXPECT_NEAR(s.choose(9, 1e-2).step, 0.01 / (55 * 1e-2), 1e-14) << "in fast flow the strain per step counts";
    EXPECT_NEAR(s.choose(0, 1e-2).step, 0.01 / (55 * 1e-2), 1e-14) << "without pressure only the strain counts";
    s.accuracy.accuracy = 0.3;
    EXPECT_NEAR(s.choose(9, 1e-3).step, 0.4 * 4 / 3, 1e-14) << "beyond it the rule fails";
    s.setting.step = 0.1;
    EXPECT_LT(s.tolerance(9, 1e-3), 0.05 * 1.25 * 1e-3 * 4 / 3 / 0.1 / 0.75 / 0.2) << "accuracies above 0.05 count as 0.05";
  }

  TEST(StepRule, ToleranceAutoFollowsStepAndStrainRate)
  {
    RuleScene s;
    EXPECT_EQ(s.tolerance(9, 1e-3), 1e-4) << "the given tolerance";
    s.accuracy.tolerance.reset();
    s.setting.step = 0.5;
    const double h = 0.5 * 3 / 4, number = 1e-3 * 4 / 3;
    EXPECT_NEAR(s.tolerance(9, 1e-3), 1.25 * 0.02 * number / (h * (0.2 + 0.8 * h)), 1e-18);
    EXPECT_EQ(s.tolerance(9, 0), 2e-5) << "without strain";
    EXPECT_EQ(s.tolerance(0, 1e-3), 2e-5) << "without pressure";
    s.setting.step = s.choose(9, 1e-5).step; // the longest step that the sweeps can serve
    EXPECT_EQ(s.choose(9, 1e-5).bound, "solver");
    EXPECT_NEAR(s.tolerance(9, 1e-5), 2e-5, 1e-17);
  }

  TEST(StepRule, LargerSamplesAreSolvedFurther)
  {
    RuleScene s;
    s.accuracy.tolerance.reset();
    s.setting.step     = 0.5;
    const double small = s.tolerance(9, 1e-3);
    while (s.state.grains.size() < 4000)
      add_grain(s.state.grains, {0, 1}, 1, 4.);
    EXPECT_NEAR(s.tolerance(9, 1e-3), small / std::pow(4., 0.75), 1e-16);
    s.setting.solver.tolerance = small;
    EXPECT_NEAR(expected_errors(s.state, s.setting, {9, 1e-3, s.accuracy}).dilation_loss, 1.25 * 0.02 * std::pow(4., 0.75),
                1e-14);
    while (s.state.grains.size() < 9000)
      add_grain(s.state.grains, {0, 1}, 1, 4.);
    EXPECT_NEAR(s.tolerance(9, 1e-3), small / std::pow(8., 0.75), 1e-16) << "the loss grows no further";
  }

  TEST(StepRule, TheErrorsOfGivenSettingsAreReported)
  {
    RuleScene s;
    s.setting.step              = 0.5;
    s.setting.solver.tolerance  = 1e-3;
    const double         h      = 0.5 * 3 / 4;
    const ExpectedErrors errors = expected_errors(s.state, s.setting, {9, 1e-3, s.accuracy});
    EXPECT_NEAR(errors.strength, 0.06 * std::sqrt(h), 1e-14);
    EXPECT_NEAR(expected_errors(s.state, s.setting, {9, 1e-2, s.accuracy}).strength, 55 * 1e-2 * 0.5, 1e-14) << "fast flow";
    EXPECT_NEAR(errors.dilation_loss, (0.2 + 0.8 * h) * 1e-3 * h / (1e-3 * 4 / 3), 1e-14);
    EXPECT_NEAR(errors.dilation(), 0.14 * std::sqrt(h) - errors.dilation_loss, 1e-14);
    EXPECT_EQ(expected_errors(s.state, s.setting, {9, 0, s.accuracy}).strength, 0);
  }

  TEST(StepRule, WithoutMotionAndPressureThereIsNoBound)
  {
    EXPECT_TRUE(std::isinf(RuleScene().choose(0, 0).step));
    EXPECT_EQ(RuleScene().choose(0, 0).bound, "none");
  }

  // At most 2.5e-4 of strain per step; the bound for end grains is 1 in units of 1.
  TEST(StepRule, ARunWithStepAutoReachesItsStagesAndNamesItsBound)
  {
    Options options       = quick_options();
    options.stepping.step = std::nullopt;
    const Course r        = loaded(small_sample(150), short_loading(), options);
    ASSERT_EQ(r.report.status, Status::finished) << r.report.message;
    EXPECT_NEAR(r.report.axial_strain, 0.01, 1e-12);
    EXPECT_TRUE(r.report.step_bound == "forces" || r.report.step_bound == "motion" || r.report.step_bound == "solver" ||
                r.report.step_bound == "strength")
      << r.report.step_bound;
    EXPECT_GT(r.report.step, 0.05);
    EXPECT_LE(r.report.step, 1);
  }

  // Mode time with walls at rest and without pressure leaves nothing to choose a step from.
  TEST(StepRule, StepAutoWithoutAnyScaleIsRefused)
  {
    SampleOptions sample    = small_sample(20);
    Options       options   = quick_options();
    options.stepping.step   = std::nullopt;
    options.lateral.lateral = Lateral::none;
    Loading loading;
    loading.pressure = 0, loading.mode = LoadingMode::time, loading.stages = {1.};
    sample.preparation_steps = 1, sample.quiet_unbalanced_force = 1e3, sample.preparation_tolerance = 1;
    EXPECT_THROW((void)loaded(sample, loading, options), std::invalid_argument);
  }

  // P3: steps from 1 to 100 times as long at the same loading between rigid sides. An unstable scheme would heat the sample
  // without bound. Here the kinetic energy stays of the order of that of the affine field. (The penalty method heats from its
  // critical step on: loading.cc.) Ten times the step changes the mean strength within its scatter. With a hundred times, 0.5 %
  // of strain per step, the strength is wrong: positions change too much for one detection per step (penetrations of 0.1 d). But
  // nothing blows up.
  TEST(StepRule, StepsOneToAHundredTimesAsLongAreStable)
  {
    double first = 0;
    for (const double step : {0.05, 0.5, 5.})
      {
        Options options                  = quick_options();
        options.stepping.step            = step;
        options.lateral.lateral          = Lateral::rigid_walls;
        options.solver.max_sweeps        = 200000;
        Loading loading                  = short_loading();
        loading.stages                   = {0.02};
        loading.horizontal_over_vertical = 0;
        const Course r                   = loaded(small_sample(100), loading, options);
        ASSERT_EQ(r.report.status, Status::finished) << "step " << step << ": " << r.report.message;
        double energy = 0, ratio = 0;
        int    n = 0;
        for (const HistoryRow &row : r.rows)
          {
            EXPECT_LT(std::abs(row.energy_residual), 1e-10);
            energy = std::max(energy, row.kinetic_energy_ratio);
            if (row.axial_strain > 0.005)
              ratio += row.stress_ratio, ++n;
          }
        ratio /= n;
        EXPECT_LT(energy, 20) << "step " << step;
        if (first == 0)
          first = ratio;
        if (step < 1)
          {
            EXPECT_NEAR(ratio, first, 0.06) << "step " << step;
          }
      }
  }
} // namespace
