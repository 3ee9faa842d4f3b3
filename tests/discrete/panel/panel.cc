// diptych: a loaded sample: stages, ledgers, determinism, early ends, loadings of too many steps
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/bodies/outline.h"
#include "discrete/contacts/internal_moment.h"
#include "discrete/samples/sample_file.h"
#include "tests/discrete/small_scenes.h"

namespace
{
  using namespace diptych::tests;

  TEST(Panel, LandsOnItsStagesAndBalancesEnergyAndMomentum)
  {
    const Course r = loaded(small_sample(), short_loading(), quick_options());
    ASSERT_EQ(r.report.status, Status::finished) << r.report.message;
    ASSERT_EQ(r.snapshots.size(), 3u);
    EXPECT_EQ(r.snapshots[0].axial_strain, 0);
    EXPECT_NEAR(r.snapshots[1].axial_strain, 0.005, 1e-12);
    EXPECT_NEAR(r.snapshots[2].axial_strain, 0.01, 1e-12);
    EXPECT_LE(r.report.step, 0.1);
    for (const HistoryRow &row : r.rows)
      {
        EXPECT_LT(row.momentum_residual, 1e-13);
        EXPECT_LT(std::abs(row.energy_residual), 1e-11);
        EXPECT_GE(row.friction_dissipation, 0);
        EXPECT_LE(row.residual, 1e-4);
        EXPECT_LT(row.max_penetration, 0.02);
      }
    // A dense sample sheared by 1 % carries a deviator of more than half of the largest one that friction 0.4 allows.
    EXPECT_GT(r.rows.back().stress_ratio, 0.2);
    EXPECT_LT(r.rows.back().stress_ratio, 0.6);
  }

  // Forces at the sides and along the platens cause the mean sxx, and every horizontal cut carries the platens' force.
  // Accelerations disturb both.
  TEST(Panel, MeanStressesBalanceTheForcesOnTheBoundary)
  {
    Options options = quick_options();
    EXPECT_GT(loaded(small_sample(), short_loading(), options).rows.back().platen_sxx, 0.03);
    options.law.platen_friction = 0;
    const Course     r          = loaded(small_sample(), short_loading(), options);
    const HistoryRow row        = r.rows.back();
    EXPECT_EQ(row.platen_sxx, 0);
    EXPECT_NEAR(row.side_sxx, row.stress(0, 0), 0.01);
    const Outline &outline = r.snapshots.back().outline;
    const double   bottom = outline.left.front().y(), height = outline.left.back().y() - bottom;
    EXPECT_NEAR(row.width, outline_area(outline) / height, 1e-9);
    const double width = outline_area(outline, bottom + height / 4, bottom + 3 * height / 4) / (height / 2);
    EXPECT_NEAR(width * row.core_stress(1, 1) / row.lower_force.y(), 1, 0.02);
  }

  TEST(Panel, SameSceneAndSeedGiveTheSameBits)
  {
    const Course a = loaded(small_sample(200), short_loading(), quick_options());
    const Course b = loaded(small_sample(200), short_loading(), quick_options());
    const Course c = loaded(small_sample(200, 2), short_loading(), quick_options());
    EXPECT_EQ(a.snapshots.back().position, b.snapshots.back().position);
    EXPECT_EQ(a.snapshots.back().internal_moment, b.snapshots.back().internal_moment);
    EXPECT_NE(a.snapshots.back().position, c.snapshots.back().position);
  }

  // Masses are true: forces times 4 at equal masses give the same path in half the time, and four times the density at the same
  // forces and inertial number in twice the time. A power of two scales every number exactly, except where the detection margin
  // adds a fixed length to a scaled one.
  TEST(Panel, ScalingTheForcesOrTheMassesScalesTheTime)
  {
    const SampleOptions sample = small_sample(200);
    const Course        a      = loaded(sample, short_loading(), quick_options());
    for (const auto &[pressure, density] : {std::pair{4., 1.}, {1., 4.}})
      {
        const double  time      = std::sqrt(density / pressure);
        SampleOptions scaled    = sample;
        Loading       loading   = short_loading();
        Options       options   = quick_options();
        loading.pressure        = pressure;
        scaled.density          = density;
        scaled.preparation_step = 0.2 * time;
        *options.stepping.step *= time;
        const Course b = loaded(scaled, loading, options);
        ASSERT_EQ(a.rows.size(), b.rows.size());
        EXPECT_NEAR(b.rows.back().time, time * a.rows.back().time, 1e-9);
        for (std::size_t i = 0; i < a.snapshots.back().position.size(); ++i)
          EXPECT_NEAR((a.snapshots.back().position[i] - b.snapshots.back().position[i]).norm(), 0, 1e-8);
        EXPECT_NEAR(b.rows.back().stress(1, 1), pressure * a.rows.back().stress(1, 1), 1e-6);
      }
  }

  TEST(Panel, AStepThatDoesNotConvergeEndsTheRunAndIsNotTaken)
  {
    Options options            = quick_options();
    options.accuracy.tolerance = 1e-12;
    options.solver.max_sweeps  = 5;
    const Course r             = loaded(small_sample(150), short_loading(), options);
    EXPECT_EQ(r.report.status, Status::not_converged);
    expect_words(r.report.message, {"did not converge"});
    EXPECT_LT(r.rows.size(), 100u);
    EXPECT_EQ(r.snapshots.size(), 1u) << "the prepared sample is kept";
  }

  // A panel that was stopped within a stage and then continues ends with the bits of an uninterrupted one.
  TEST(Panel, StopsAtTheNextStepOnRequestAndGoesOnWithTheSameBits)
  {
    const Course whole = loaded(small_sample(150), short_loading(), quick_options());
    int          steps = 0;
    Hooks        hooks;
    hooks.on_row         = [&](const HistoryRow &) { ++steps; };
    hooks.stop_requested = [&] { return steps == 7; };
    Panel                 panel(small_sample(150), short_loading(), quick_options(), hooks);
    std::vector<Snapshot> snapshots;
    const Report          report = run_to_end(panel, 2, snapshots);
    EXPECT_EQ(report.status, Status::stopped_by_user);
    EXPECT_EQ(steps, 7);
    ASSERT_EQ(snapshots.size(), 2u) << "the prepared sample and the last accepted step";
    EXPECT_NEAR(snapshots.back().axial_strain, report.axial_strain, 1e-12);
    EXPECT_GT(report.axial_strain, 0);
    steps = 100; // the hook no longer stops
    ASSERT_EQ(panel.advance_to(2), Status::finished);
    EXPECT_EQ(panel.snapshot().position, whole.snapshots.back().position);
    EXPECT_EQ(panel.snapshot().internal_moment, whole.snapshots.back().internal_moment);
  }

  // At the 30th call the preparation relaxes soft discs or does its first sweeps. There is no step and no snapshot, and the
  // report says that the user stopped it.
  TEST(Panel, StopsWithinItsPreparationOnRequest)
  {
    int   asked = 0;
    Hooks hooks;
    hooks.stop_requested = [&] { return ++asked >= 30; };
    Panel panel(small_sample(150), short_loading(), quick_options(), hooks);
    EXPECT_EQ(panel.prepare(), Status::stopped_by_user);
    EXPECT_LE(asked, 34);
    EXPECT_FALSE(panel.has_snapshot());
  }

  TEST(Panel, StopsWhileItsFileIsReadOnRequest)
  {
    const Folder  folder;
    SampleOptions sample = small_sample(100);
    sample.file          = folder / "grains.csv";
    write_grains_csv(sample.file, loaded(small_sample(100), short_loading(), quick_options()).prepared);
    Hooks hooks;
    hooks.stop_requested = [] { return true; };
    Panel panel(sample, short_loading(), quick_options(), hooks);
    EXPECT_EQ(panel.prepare(), Status::stopped_by_user);
    EXPECT_FALSE(panel.has_snapshot());
  }

  // Grains from arrays equal the grains of a file with the same numbers.
  TEST(Panel, GrainsFromArraysAreThoseOfAFile)
  {
    const Folder  folder;
    const Grains  grains   = loaded(small_sample(100), short_loading(), quick_options()).prepared;
    SampleOptions sample   = small_sample(100);
    sample.allowed_overlap = 0.1;
    Panel from_arrays(sample, short_loading(), quick_options(), {}, grains);
    sample.file = folder / "grains.csv";
    write_grains_csv(sample.file, grains);
    Panel                 from_file(sample, short_loading(), quick_options());
    std::vector<Snapshot> a, b;
    EXPECT_EQ(run_to_end(from_arrays, 2, a).status, Status::finished);
    EXPECT_EQ(run_to_end(from_file, 2, b).status, Status::finished);
    EXPECT_EQ(a.back().position, b.back().position);
    EXPECT_EQ(a.back().mean_internal_moment, b.back().mean_internal_moment);
  }

  // The rebound of springs follows from their dashpots, and they have no problems of rigid contacts.
  TEST(Panel, KeysThatSpringsWouldIgnoreAndStagesOutOfOrderAreRefused)
  {
    for (const Method method : {Method::penalty, Method::compliant})
      {
        Options springs       = quick_options();
        springs.method.method = method;
        Options rebound = springs, problems = springs;
        rebound.law.normal_restitution = 0.5;
        problems.method.store_problems = true;
        for (const Options &options : {rebound, problems})
          EXPECT_THROW(Panel(small_sample(150), short_loading(), options), std::invalid_argument);
      }
    Loading loading = short_loading();
    loading.stages  = {0.01, 0.005};
    EXPECT_THROW(Panel(small_sample(150), loading, quick_options()), std::invalid_argument);
  }

  // The mean forces of a window carry the mean stress of its steps. Their moments differ only by the motion within the window.
  TEST(Panel, WindowForcesCarryTheMeanStress)
  {
    const Course    r    = loaded(small_sample(), short_loading(), quick_options());
    const Snapshot &last = r.snapshots.back();
    Eigen::Matrix2d mean = Eigen::Matrix2d::Zero(), moment = Eigen::Matrix2d::Zero();
    int             n = 0;
    for (const HistoryRow &row : r.rows)
      if (row.axial_strain > 0.005 + 1e-9)
        mean += row.stress, ++n;
    for (const Eigen::Matrix2d &m : last.mean_internal_moment)
      moment += m;
    EXPECT_NEAR((moment / last.area - mean / n).norm() / mean.norm() * n, 0, 0.01);
  }

  Loading far_as_one_percent()
  {
    Loading loading;
    loading.stages = {0.01};
    return loading;
  }

  // Steps = strain / (I h) with h in d sqrt(rho/P). The step of the rule decreases with I once its tolerance is at its limit, so
  // the number of steps grows with 1/I^2.
  TEST(EndlessLoading, TooManyStepsAreRefusedForGivenAndAutomaticSteps)
  {
    Loading loading         = far_as_one_percent();
    loading.inertial_number = 1e-9;
    Options options         = quick_options();
    options.stepping.step   = 1e-3; // 0.01 / 1e-9 / 1e-3 = 1e10
    const auto check        = [&] { validate(small_sample(150), loading, options); };
    expect_refused({"1e+10 steps"}, check);
    options.stepping.step.reset();
    options.accuracy.tolerance.reset();
    expect_refused({"discrete/step = auto"}, check);
    const double fast = [&] { return loading.inertial_number = 2e-5, expected_steps(small_sample(150), loading, options); }();
    const double slow = [&] { return loading.inertial_number = 1e-6, expected_steps(small_sample(150), loading, options); }();
    EXPECT_GT(slow / fast, 20) << "more than 1/I";
    EXPECT_NO_THROW(check());
  }

  // Demands of the walls' tables become known only when the loading begins.
  TEST(EndlessLoading, TooManyStepsDueToWallTablesStopTheRun)
  {
    const Folder folder;
    write_text(folder / "steep.csv", "time,velocity\n0,0\n1e-12,-0.02\n3,-0.02\n");
    Options options         = quick_options();
    options.lateral.lateral = Lateral::rigid_walls;
    options.stepping.step.reset();
    options.drives.upper_y = "velocity " + folder / "steep.csv";
    Loading loading        = far_as_one_percent();
    loading.mode           = LoadingMode::time;
    loading.stages         = {1.};
    const Course course    = loaded(small_sample(150), loading, options);
    EXPECT_EQ(course.report.status, Status::not_converged);
    expect_words(course.report.message, {"1e+13 steps", "drives"});
    EXPECT_EQ(course.snapshots.size(), 1u) << "the prepared sample is kept";
  }
} // namespace
