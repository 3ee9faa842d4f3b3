// diptych: loadings that would take too many steps
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/files/text_file.h"
#include "tests/discrete/small_scenes.h"
#include "tests/files.h"

namespace
{
  using namespace diptych::tests;

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
