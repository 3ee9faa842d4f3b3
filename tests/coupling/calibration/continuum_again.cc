// diptych: finds seven parameters of a boundary problem from its own data and a poor start
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>

#include <gtest/gtest.h>

#include "coupling/calibration/calibrate.h"
#include "tests/continuum/continuum_scenes.h"
#include "tests/coupling/calibration/surrogate.h"

namespace
{
  using namespace diptych::coupling;
  using namespace diptych::coupling::tests;
  namespace continuum = diptych::continuum;

  constexpr double width = 30, height = 42;

  Scene sheared()
  {
    Scene scene;
    scene.sample.mean_diameter    = 1;
    scene.loading.axial_strain    = 0.03;
    scene.comparison.window_edges = {0.005, 0.015, 0.03};
    return scene;
  }

  Calibration seven_parameters()
  {
    Calibration c = six_parameters();
    c.kinds.push_back(ObservableKind::ln_width);
    c.parameters.push_back({"internal_length", Coordinate::logarithm, "", 4, 1, 8});
    c.parameters[0].start = 28, c.parameters[1].start = 0.5, c.parameters[2].start = 0.85;
    c.noise.stress_discrepancy = 1e-5, c.noise.early_stress_discrepancy = 0, c.noise.volume_discrepancy = 1e-6;
    c.noise.width_discrepancy = 1e-3;
    c.noise.stress_level = c.noise.stress_shape = 1e-5, c.noise.volume_start = c.noise.volume_growth = 1e-6;
    c.noise.ln_width = 1e-3;
    return c;
  }

  // 45 degree shear of a rectangle, rough platens, elements of 3 d, 25 equal steps.
  ModelRun run_of(const Settings &settings, const std::vector<Observable> &observables)
  {
    ModelRun           run;
    continuum::Options options;
    options.initial_step = options.max_step = 0.0012;
    try
      {
        options.material                      = options_of(settings);
        const continuum::tests::Course course = continuum::tests::finished(
          continuum::tests::rectangle(width, height, 3),
          continuum::straight_loading(1, {height, -height}, {0, 0.005, 0.015, 0.03}), options);
        SampleFrame frame;
        frame.centre = {width / 2, height / 2}, frame.width = width, frame.height = height;
        std::vector<SampleFrame> frames(2, frame);
        frames[0].platen_increment = {0.01 * height, -0.01 * height};
        frames[1].platen_increment = {0.015 * height, -0.015 * height};
        run.observation            = observe(sheared(), observables, history_table(course.rows), course.snapshots, frames);
      }
    catch (const std::exception &error)
      {
        run.words = error.what();
      }
    return run;
  }

  TEST(CalibrateContinuum, FindsSevenParametersAgain)
  {
    const Calibration   c = seven_parameters();
    const Coordinates   coordinates(c.parameters, {});
    std::vector<double> truths = six_truths;
    truths.push_back(2);
    const auto observables = observables_of(c, sheared());
    ASSERT_EQ(observables.size(), 28u);
    const ModelRun truth = run_of(coordinates.settings(point_of(c, truths), ""), observables);
    ASSERT_TRUE(truth.words.empty()) << truth.words;
    ASSERT_TRUE(std::isfinite(truth.observation.angle_deg)) << "there is no band to measure";
    TargetData data;
    data.observables = observables;
    data.samples     = {truth.observation.values, truth.observation.values};
    summarise(data);
    std::vector<CalibrationPath> paths{{c.targets.front(), sheared(), data, {truth.observation, truth.observation}, {}}};
    paths.front().left_out.resize(observables.size());
    CalibrationRecord record;
    calibrate(
      c, coordinates, paths,
      [&](const ModelTask &task) {
        std::vector<std::vector<ModelRun>> runs;
        for (const std::vector<Settings> &point : task.points)
          runs.push_back({run_of(point.front(), observables)});
        return runs;
      },
      record);
    ASSERT_EQ(record.status, "finished");
    for (std::size_t k = 0; k < truths.size(); ++k)
      EXPECT_NEAR(record.parameters[k].number / truths[k], 1, 1e-3) << record.parameters[k].key;
    EXPECT_LE(record.coarse_runs, 60);
    EXPECT_LE(record.fine_runs, 10);
  }
} // namespace
