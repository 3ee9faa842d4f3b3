// diptych: a calibration finds known parameters again, and its intervals hold
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>
#include <random>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "coupling/calibration/identification.h"
#include "coupling/calibration/least_squares.h"
#include "tests/coupling/calibration/surrogate.h"

namespace
{
  using namespace diptych::coupling;
  using namespace diptych::coupling::tests;

  TEST(Coordinates, SharesAndDropsReferToOtherKeys)
  {
    const Calibration c = six_parameters();
    const Coordinates coordinates(c.parameters, {});
    const auto        values = coordinates.values(point_of(c, six_truths));
    EXPECT_NEAR(values[0], 23, 1e-9);
    EXPECT_NEAR(values[1], 23 * 0.65, 1e-9);
    EXPECT_NEAR(values[2], 23 * 0.6, 1e-9);
    EXPECT_NEAR(values[4], 23 * 0.6 * 0.7, 1e-9);
    EXPECT_NEAR(values[5], 900, 1e-6);
    EXPECT_EQ(coordinates.settings(coordinates.start(), "")[3].key, "mobilisation_strain");
    const std::vector<CalibrationParameter> alone = {
      {"dilatancy_angle_peak", Coordinate::share_of, "friction_angle_peak", 0.5, 0, 1}};
    EXPECT_NEAR(
      Coordinates(alone, {{"friction_angle_peak", 30}}).values(Coordinates(alone, {{"friction_angle_peak", 30}}).start())[0], 15,
      1e-9);
    EXPECT_THROW(Coordinates(alone, {}), std::invalid_argument);
    EXPECT_THROW(Coordinates({{"cohesion", Coordinate::share_of, "cohesion", 0.5, 0, 1}}, {}), std::invalid_argument);
  }

  TEST(Coordinates, AParameterMayBelongToSomeTargets)
  {
    const CalibrationParameter common = {"friction_angle_peak", Coordinate::value, "", 30, 10, 40};
    const CalibrationParameter dense  = {
       "friction_angle_start", Coordinate::share_of, "friction_angle_peak", 0.8, 0, 1, {"dense"}};
    const CalibrationParameter loose = {
      "friction_angle_start", Coordinate::share_of, "friction_angle_peak", 0.2, 0, 1, {"loose"}};
    const Coordinates coordinates({common, dense, loose}, {});
    const auto        start_of = [&](const std::string &target) {
      const Settings settings = coordinates.settings(coordinates.start(), target);
      return settings.size() < 2 ? std::string() : settings.at(1).key + " " + settings.at(1).value;
    };
    EXPECT_EQ(start_of("dense"), "friction_angle_start 24");
    EXPECT_EQ(start_of("loose"), "friction_angle_start 6");
    EXPECT_EQ(start_of("medium"), "");
    EXPECT_EQ(start_of(""), "");
    EXPECT_NEAR(coordinates.values(coordinates.start())[2], 6, 1e-9);
    // A key that differs between targets gives a common parameter no value.
    const CalibrationParameter share = {"dilatancy_angle_peak", Coordinate::share_of, "friction_angle_start", 0.5, 0, 1};
    EXPECT_THROW(Coordinates({common, dense, loose, share}, {{"friction_angle_start", 20}}), std::invalid_argument);
  }

  // r = 100 (data - a exp(-b t)) in scaled coordinates. Beyond the wall the run fails.
  std::vector<Eigen::VectorXd> decays(const std::vector<Eigen::VectorXd> &points, const double wall, int &runs)
  {
    std::vector<Eigen::VectorXd> residuals;
    for (const Eigen::VectorXd &p : points)
      {
        Eigen::VectorXd r(20);
        for (int k = 0; k < 20; ++k)
          r[k] = 100 * ((0.2 + p[0]) * std::exp(-3 * p[1] * 0.1 * k) - 0.7 * std::exp(-1.2 * 0.1 * k));
        ++runs;
        residuals.push_back(p[0] > wall ? Eigen::VectorXd() : r);
      }
    return residuals;
  }

  TEST(LeastSquares, FindsTheMinimumWithFewRuns)
  {
    for (const Eigen::Vector2d &start : {Eigen::Vector2d(0.9, 0.9), Eigen::Vector2d(0.05, 0.05), Eigen::Vector2d(1, 0)})
      {
        int        runs = 0;
        const auto fit  = least_squares([&](const auto &points) { return decays(points, 2, runs); }, start);
        EXPECT_TRUE(fit.arrived) << fit.words;
        EXPECT_NEAR(fit.point[0], 0.5, 1e-3);
        EXPECT_NEAR(fit.point[1], 0.4, 1e-3);
        EXPECT_EQ(fit.evaluations, runs);
        EXPECT_LE(runs, 25);
      }
  }

  TEST(LeastSquares, KeepsToBoundsAndAvoidsFailedRuns)
  {
    int        runs   = 0;
    const auto walled = least_squares([&](const auto &points) { return decays(points, 0.45, runs); }, Eigen::Vector2d(0.1, 0.6));
    EXPECT_LE(walled.point[0], 0.45);
    EXPECT_GT(walled.point[0], 0.35) << "it should come close to the wall in front of the minimum";
    const auto beyond = least_squares(
      [&](const std::vector<Eigen::VectorXd> &points) {
        std::vector<Eigen::VectorXd> shifted = points;
        for (Eigen::VectorXd &p : shifted)
          p[0] *= 0.3; // the minimum lies at 1.67
        return decays(shifted, 2, runs);
      },
      Eigen::Vector2d(0.5, 0.5));
    EXPECT_NEAR(beyond.point[0], 1, 1e-6);
    const auto nothing = least_squares([&](const auto &points) { return decays(points, -1, runs); }, Eigen::Vector2d(0.5, 0.5));
    EXPECT_FALSE(nothing.arrived);
    EXPECT_FALSE(nothing.words.empty());
  }

  // Samples with known level, shape, growth and width.
  TargetData drawn(const NoiseModel              &noise,
                   const std::vector<Observable> &observables,
                   const Eigen::VectorXd         &truth,
                   const int                      n,
                   const unsigned                 seed)
  {
    const Eigen::MatrixXd            root = covariance(noise, observables).llt().matrixL();
    std::mt19937                     random(seed);
    std::normal_distribution<double> normal;
    TargetData                       data;
    data.observables = observables;
    for (int k = 0; k < n; ++k)
      {
        Eigen::VectorXd z(truth.size());
        for (double &one : z)
          one = normal(random);
        data.samples.push_back(truth + root * z);
      }
    summarise(data);
    return data;
  }

  NoiseModel usual_noise()
  {
    NoiseModel noise;
    noise.stress_level = 0.02, noise.stress_shape = 0.0045, noise.volume_start = 1e-4, noise.volume_growth = 0.04;
    noise.ln_width = 0.3;
    return noise;
  }

  std::vector<Observable> usual_observables()
  {
    std::vector<Observable> observables;
    for (const ObservableKind kind : {ObservableKind::stress_ratio, ObservableKind::volumetric_strain})
      for (int k = 0; k < 13; ++k)
        observables.push_back({kind, 0.03 * k / 13, 0.03 * (k + 1) / 13});
    for (int k = 0; k < 3; ++k)
      observables.push_back({ObservableKind::ln_width, 0.01 * k, 0.01 * (k + 1)});
    return observables;
  }

  TEST(Noise, IsFoundAgain)
  {
    const auto       observables = usual_observables();
    const NoiseModel truth       = usual_noise();
    const auto       data        = drawn(truth, observables, Eigen::VectorXd::Constant(29, 0.3), 200, 3);
    const NoiseModel found       = noise_of({data}, {});
    EXPECT_NEAR(found.stress_level, 0.02, 0.003);
    EXPECT_NEAR(found.stress_shape, 0.0045, 0.0006);
    EXPECT_NEAR(found.volume_growth, 0.04, 0.006);
    EXPECT_NEAR(found.ln_width, 0.3, 0.03);
    EXPECT_EQ(found.degrees_of_freedom, 199);
    NoiseOptions told;
    told.stress_level = 0.5;
    EXPECT_EQ(noise_of({data}, told).stress_level, 0.5);
    const auto alone = drawn(truth, observables, Eigen::VectorXd::Constant(29, 0.3), 1, 3);
    EXPECT_THROW((void)noise_of({alone}, {}), std::invalid_argument);
  }

  TEST(Noise, WeightsLeaveTheCommonLevelOut)
  {
    const auto data    = drawn(usual_noise(), usual_observables(), Eigen::VectorXd::Constant(29, 0.3), 4, 3);
    const auto weights = working_weights(usual_noise(), {}, data);
    const auto one     = 1 / std::sqrt(weights[12]);
    EXPECT_NEAR(one, std::hypot(0.008, 0.0045 / 2), 1e-4) << "model tolerance 0.008, shape 0.0045 on four samples";
  }

  TEST(Identification, ReportsParametersThatTheDataDoNotDetermine)
  {
    Eigen::MatrixXd jacobian(3, 3);
    jacobian << 1, 0, 0, 0, 1, 1, 0, 0, 0; // only the sum of the second and third is determined
    const auto known = identify(jacobian, Eigen::Vector3d::Constant(1e4), 1e-4 * Eigen::Matrix3d::Identity());
    EXPECT_TRUE(known.is_identified[0]);
    EXPECT_FALSE(known.is_identified[1]);
    EXPECT_FALSE(known.is_identified[2]);
    EXPECT_NEAR(known.deviation[0], 0.01, 1e-4);
    EXPECT_NEAR(known.correlation(1, 2), -1, 0.01);
  }

  CalibrationPath path_with(const Calibration &c, TargetData data, const std::size_t target = 0)
  {
    CalibrationPath path{c.targets[target], {}, std::move(data), {}, {}};
    for (const Eigen::VectorXd &values : path.data.samples)
      {
        path.samples.emplace_back();
        path.samples.back().values = values;
      }
    path.left_out.resize(path.data.observables.size());
    return path;
  }

  CalibrationRecord calibrated(const Calibration &c, const std::vector<CalibrationPath> &paths)
  {
    const Coordinates coordinates(c.parameters, {});
    CalibrationRecord record;
    calibrate(
      c, coordinates, paths,
      [&](const ModelTask &task) {
        std::vector<std::vector<ModelRun>> runs;
        for (const std::vector<Settings> &point : task.points)
          {
            runs.emplace_back();
            for (std::size_t k = 0; k < task.paths.size(); ++k)
              runs.back().push_back(surrogate(point[k], paths[task.paths[k]].data.observables));
          }
        return runs;
      },
      record);
    return record;
  }

  // Synthetic data need no model tolerance.
  Calibration exact()
  {
    Calibration c              = six_parameters();
    c.noise.stress_discrepancy = 1e-5, c.noise.early_stress_discrepancy = 0, c.noise.volume_discrepancy = 1e-6;
    return c;
  }

  std::vector<Observable> bins_of(const Calibration &c)
  {
    Scene scene;
    scene.loading.axial_strain = 0.03;
    return observables_of(c, scene);
  }

  Eigen::VectorXd truth_of(const Calibration &c)
  {
    const Coordinates coordinates(c.parameters, {});
    return surrogate(coordinates.settings(point_of(c, six_truths), ""), bins_of(c)).observation.values;
  }

  TEST(Calibrate, FindsParametersOfItsOwnDataAgain)
  {
    Calibration c        = exact();
    c.noise.stress_level = c.noise.stress_shape = 1e-5, c.noise.volume_start = c.noise.volume_growth = 1e-6;
    TargetData data;
    data.observables = bins_of(c);
    data.samples     = {truth_of(c), truth_of(c)};
    summarise(data);
    const CalibrationRecord record = calibrated(c, {path_with(c, data)});
    ASSERT_EQ(record.status, "finished");
    for (std::size_t k = 0; k < six_truths.size(); ++k)
      EXPECT_NEAR(record.parameters[k].number / six_truths[k], 1, 1e-3) << record.parameters[k].key;
    EXPECT_LE(record.coarse_runs, 60);
    EXPECT_LE(record.fine_runs, 10);
  }

  // Two preparations of one material. Each has its own initial mobilisation; all other parameters are common. A third path has
  // none of the two own values.
  TEST(Calibrate, FindsValuesOfSingleTargets)
  {
    Calibration c        = exact();
    c.noise.stress_level = c.noise.stress_shape = 1e-5, c.noise.volume_start = c.noise.volume_growth = 1e-6;
    c.targets = {{"dense", "", {}, {}, {1, 2}, true}, {"loose", "", {}, {}, {1, 2}, true}, {"other", "", {}, {}, {1, 2}, false}};
    c.parameters = {{"friction_angle_peak", Coordinate::logarithm, "", 28, 12, 45},
                    {"mobilisation_strain", Coordinate::logarithm, "", 0.01, 5e-4, 0.05},
                    {"friction_angle_start", Coordinate::value, "", 15, 1, 20, {"dense"}},
                    {"friction_angle_start", Coordinate::value, "", 10, 1, 20, {"loose"}}};
    c.fixed      = {{"continuum", "dilatancy_angle_peak", "3", "", ""}, {"continuum", "friction_angle_residual", "12", "", ""}};
    const std::vector<double>    truths = {24, 0.004, 18, 5};
    const Coordinates            coordinates(c.parameters, {});
    std::vector<CalibrationPath> paths;
    for (std::size_t p = 0; p < c.targets.size(); ++p)
      {
        TargetData data;
        data.observables        = bins_of(c);
        Settings       settings = c.fixed;
        const Settings own      = coordinates.settings(point_of(c, truths), c.targets[p].name);
        settings.insert(settings.end(), own.begin(), own.end());
        const ModelRun truth  = surrogate(settings, data.observables);
        const auto    &values = truth.observation.values;
        ASSERT_GT(values.size(), 0) << truth.words;
        data.samples = {values, values};
        summarise(data);
        paths.push_back(path_with(c, data, p));
      }
    const CalibrationRecord record = calibrated(c, paths);
    ASSERT_EQ(record.status, "finished");
    for (std::size_t k = 0; k < truths.size(); ++k)
      EXPECT_NEAR(record.parameters[k].number / truths[k], 1, 1e-3) << record.parameters[k].key << ' ' << k;
    ASSERT_EQ(record.own.size(), 2u);
    EXPECT_EQ(record.own[0].target, "dense");
    EXPECT_NEAR(record.own[1].value, 5, 5e-3);
    EXPECT_EQ(record.settings.size(), c.fixed.size() + 2) << "a value of one target must not be a setting of all";
  }

  struct Coverage
  {
    int    n = 0, held = 0;
    double squares = 0;

    double rms() const { return std::sqrt(squares / n); }
    double share() const { return double(held) / n; }
  };

  // Twenty data sets of four samples. Errors are relative to half the interval, expressed in deviations of a normal
  // distribution.
  Coverage coverage_of(const Calibration &c)
  {
    const NoiseModel      noise       = usual_noise();
    const auto            observables = bins_of(c);
    const Eigen::VectorXd truth       = truth_of(c);
    Coverage              result;
    for (unsigned set = 1; set <= 20; ++set)
      {
        const CalibrationRecord record = calibrated(c, {path_with(c, drawn(noise, observables, truth, 4, set))});
        for (std::size_t k = 0; k < six_truths.size(); ++k)
          {
            const ParameterRecord &p = record.parameters[k];
            if (!p.is_identified || p.at_bound)
              continue;
            const bool   logarithm = p.coordinate == "logarithm";
            const double width     = logarithm ? std::log(p.number_high / p.number_low) : p.number_high - p.number_low;
            const double error     = logarithm ? std::log(p.number / six_truths[k]) : p.number - six_truths[k];
            result.squares += std::pow(error / (width / (2 * 1.96)), 2);
            result.held += six_truths[k] >= p.number_low && six_truths[k] <= p.number_high;
            ++result.n;
          }
      }
    std::printf("%d intervals, rms z %.3f, coverage %.3f\n", result.n, result.rms(), result.share());
    return result;
  }

  TEST(Calibrate, StatesDeviationsThatHold)
  {
    Calibration      c     = exact();
    const NoiseModel noise = usual_noise();
    c.noise.stress_level = noise.stress_level, c.noise.stress_shape = noise.stress_shape;
    c.noise.volume_start = noise.volume_start, c.noise.volume_growth = noise.volume_growth;
    const Coverage found = coverage_of(c);
    ASSERT_GE(found.n, 60);
    EXPECT_GT(found.rms(), 0.7);
    EXPECT_LT(found.rms(), 1.3);
    EXPECT_GE(found.share(), 0.88);
  }

  // The same with noise estimated from four samples. Student's quantile keeps the coverage that the normal one would lose.
  TEST(Calibrate, IntervalsHoldWithNoiseFromFourSamples)
  {
    const Coverage found = coverage_of(exact());
    ASSERT_GE(found.n, 60);
    EXPECT_GE(found.share(), 0.88);
    EXPECT_GT(found.rms(), 0.4) << "the intervals must not be too wide";
  }
} // namespace
