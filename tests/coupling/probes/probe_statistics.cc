// diptych: tests of intervals, dispersion and differences of probes, on samples of known truth
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/probes/probe_statistics.h"
#include "coupling/probes/probes.h"
#include "tests/coupling/averaging/hexagonal_lattice.h"
#include "tests/coupling/synthetic_samples.h"

namespace
{
  using namespace diptych::coupling;

  ProbeRegion probe_of(const std::string &name, const Eigen::Vector2d &low, const double length, const double height)
  {
    return {
      name, {low, low + Eigen::Vector2d(length, 0), low + Eigen::Vector2d(length, height), low + Eigen::Vector2d(0, height)}, 0};
  }

  // Grains on a square lattice under the mean stress `stress`. Each moment is scattered by `scatter`, and squares of 4 x 4 grains
  // have a common scatter of the same size. There is one contact per grain and direction, drawn from the density (1 + a cos 2
  // (theta - fabric)) / 2 pi.
  struct Truth
  {
    Eigen::Matrix2d stress;
    double          scatter, anisotropy, fabric_deg;
  };
  GrainNetwork scattered(std::mt19937_64 &random, const Truth &truth, const int columns, const int rows)
  {
    const auto tensor = [&] {
      Eigen::Matrix2d t;
      t << synthetic::normal(random), 0, 0, synthetic::normal(random);
      t(0, 1) = t(1, 0) = synthetic::normal(random) / std::sqrt(2.);
      return Eigen::Matrix2d(truth.scatter * t);
    };
    std::vector<Eigen::Matrix2d> common(((columns + 3) / 4) * ((rows + 3) / 4));
    for (auto &t : common)
      t = tensor();
    GrainNetwork network;
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column)
        {
          network.position.emplace_back(column + 0.5, row + 0.5);
          network.radius.push_back(0.5);
          network.moment.push_back(truth.stress + tensor() + common[row / 4 * ((columns + 3) / 4) + column / 4]);
          for (int contact = 0; contact < 2; ++contact)
            {
              double theta;
              do
                theta = synthetic::uniform(random, 0, 2 * M_PI);
              while (synthetic::uniform(random, 0, 1 + truth.anisotropy) >
                     1 + truth.anisotropy * std::cos(2 * (theta - truth.fabric_deg * M_PI / 180)));
              network.contacts.push_back({0, 1, network.position.back(), {std::cos(theta), std::sin(theta)}, {1, 0}});
            }
        }
    return network;
  }

  Truth usual_truth()
  {
    // 3 along 30 degrees and 1.5 across: t/s = 1/3.
    Eigen::Matrix2d stress;
    stress << 2.25 + 0.375, 0.75 * std::sqrt(0.75), 0.75 * std::sqrt(0.75), 2.25 - 0.375;
    return {stress, 1, 0.4, 20};
  }

  bool covers(const Interval &interval, const double truth)
  {
    return interval.low <= truth && truth <= interval.high;
  }

  // Without resampling the numbers are those of the probe itself.
  TEST(ProbeStatistics, BlocksAddUpToTheProbe)
  {
    std::mt19937_64    random(1);
    const GrainNetwork network = scattered(random, usual_truth(), 40, 40);
    const ProbeRegion  probe   = probe_of("zone", {5.2, 7.1}, 26, 17);
    const ProbeBlocks  blocks  = probe_blocks(probe, network, 5);
    EXPECT_EQ(blocks.block.size(), 15u); // 26/5 x 17/5
    const ProbeNumbers numbers = probe_numbers(blocks, std::vector<int>(15, 1));
    const ProbeStress  stress  = grain_probe_stress(probe, network.position, network.radius, network.moment);
    const ProbeFabric  fabric  = probe_fabric(probe, network.contacts);
    EXPECT_NEAR(numbers.s1, stress.s1, 1e-12);
    EXPECT_NEAR(numbers.s2, stress.s2, 1e-12);
    EXPECT_NEAR(numbers.t_over_s, stress.t_over_s, 1e-12);
    EXPECT_NEAR(numbers.direction_deg, stress.direction_deg, 1e-10);
    EXPECT_NEAR(numbers.anisotropy, fabric.anisotropy, 1e-12);
    EXPECT_NEAR(numbers.fabric_direction_deg, fabric.direction_deg, 1e-10);
    EXPECT_NEAR(numbers.fabric_to_stress_deg, fabric.direction_deg - stress.direction_deg, 1e-10);
  }

  TEST(ProbeStatistics, UniformStressHasIntervalsOfLengthZero)
  {
    const GrainNetwork   network   = synthetic::hexagonal_network(60, 60, usual_truth().stress);
    const ProbeIntervals intervals = probe_intervals(probe_blocks(probe_of("zone", {10, 10}, 30, 20), network, 5), {5, 200, 1});
    EXPECT_NEAR(intervals.s1.high - intervals.s1.low, 0, 1e-12);
    EXPECT_NEAR(intervals.t_over_s.value, 1. / 3, 1e-12);
    EXPECT_NEAR(intervals.t_over_s.high - intervals.t_over_s.low, 0, 1e-12);
    EXPECT_NEAR(intervals.direction_deg.value, 30, 1e-10);
  }

  // 24 blocks of 5 x 5 in a probe of 30 x 20, with grains correlated over 4, so that block edges cut correlated groups. Nominal
  // coverage 95 %; binomial scatter of 200 samples 1.5 %. Independent blocks would cover 85 %. The angle from stress to fabric is
  // 20 - 30 degrees.
  TEST(ProbeStatistics, IntervalsCoverTheTruth)
  {
    std::mt19937_64   random(12);
    const ProbeRegion probe      = probe_of("zone", {5.2, 7.1}, 30, 20);
    const double      solid      = M_PI / 4; // stress = moment density, one grain per unit square
    int               covered[7] = {};
    for (int sample = 0; sample < 200; ++sample)
      {
        const auto blocks = probe_blocks(probe, scattered(random, usual_truth(), 40, 36), 5);
        EXPECT_NEAR(blocks.solid_fraction, solid, 0.02);
        const ProbeIntervals i = probe_intervals(blocks, {5, 200, 1});
        covered[0] += covers(i.s1, 3);
        covered[1] += covers(i.s2, 1.5);
        covered[2] += covers(i.t_over_s, 1. / 3);
        covered[3] += covers(i.direction_deg, 30);
        covered[4] += covers(i.anisotropy, 0.4);
        covered[5] += covers(i.fabric_direction_deg, 20);
        covered[6] += covers(i.fabric_to_stress_deg, -10);
      }
    for (const int n : covered)
      {
        EXPECT_GE(n, 178);
        EXPECT_LE(n, 198);
      }
  }

  // Fabric and stress at +-89 degrees are lines 2 degrees apart, and the interval includes the vertical.
  TEST(ProbeStatistics, IntervalsOfDirectionsMayIncludeTheVertical)
  {
    std::mt19937_64 random(3);
    Truth           truth = usual_truth();
    const double    angle = 89 * M_PI / 180;
    truth.stress          = 2.25 * Eigen::Matrix2d::Identity();
    truth.stress(0, 0) += 0.75 * std::cos(2 * angle);
    truth.stress(1, 1) -= 0.75 * std::cos(2 * angle);
    truth.stress(0, 1) = truth.stress(1, 0) = 0.75 * std::sin(2 * angle);
    truth.fabric_deg                        = -89;
    const auto intervals = probe_intervals(probe_blocks(probe_of("zone", {5, 5}, 30, 20), scattered(random, truth, 40, 36), 5),
                                           {5, 400, 1});
    EXPECT_LE(std::abs(intervals.fabric_to_stress_deg.value), 30);
    EXPECT_TRUE(covers(intervals.fabric_to_stress_deg, 2));
    EXPECT_LT(intervals.direction_deg.high - intervals.direction_deg.low, 40);
    EXPECT_LT(intervals.direction_deg.low, intervals.direction_deg.value);
    EXPECT_GT(intervals.direction_deg.high, intervals.direction_deg.value);
  }

  TEST(ProbeStatistics, TooFewBlocksGiveNoInterval)
  {
    std::mt19937_64      random(3);
    const GrainNetwork   network   = scattered(random, usual_truth(), 40, 36);
    const ProbeIntervals intervals = probe_intervals(probe_blocks(probe_of("upper", {5, 5}, 14, 9), network, 5), {5, 400, 1});
    EXPECT_EQ(intervals.blocks, 2);
    EXPECT_TRUE(std::isfinite(intervals.s1.value));
    EXPECT_TRUE(std::isnan(intervals.s1.low));
    EXPECT_TRUE(std::isnan(probe_intervals(probe_blocks({"upper", {}, 0}, network, 5), {5, 400, 1}).s1.value));
  }

  // Pressures 1 .. 101 on grains of two sizes: mean 51, variance 101 * 102 / 12, percentiles 1 + p.
  TEST(ProbeStatistics, DispersionOfGrainPressures)
  {
    GrainNetwork network;
    for (int k = 0; k < 101; ++k)
      {
        network.position.emplace_back(k, 0.5);
        network.radius.push_back(k % 2 ? 0.3 : 0.5);
        Eigen::Matrix2d moment;
        moment << 1.5, 0.2, 0.2, 0.5; // half the trace is 1
        network.moment.push_back((1 + (37 * k) % 101) * M_PI * std::pow(network.radius.back(), 2) * moment);
      }
    const GrainPressure pressure = grain_pressure(probe_of("zone", {-1, 0}, 103, 1), network);
    EXPECT_EQ(pressure.grains, 101);
    EXPECT_NEAR(pressure.mean, 51, 1e-12);
    EXPECT_NEAR(pressure.deviation, std::sqrt(101 * 102 / 12.), 1e-12);
    for (int k = 0; k < 5; ++k)
      EXPECT_NEAR(pressure.percentiles[k], 1 + percentile_levels[k], 1e-12);
    EXPECT_TRUE(std::isnan(grain_pressure({"upper", {}, 0}, network).mean));
  }

  // For two probes of one state, 95 % of the intervals of their difference contain 0. Two states whose t/s are 1/3 and 3/4 must
  // differ: they are 0.42 apart, four to five times the deviation of the difference (0.05 sqrt 2 plus the stretching).
  TEST(ProbeStatistics, FindsRealDifferencesOnly)
  {
    std::mt19937_64          random(8);
    std::vector<ProbeRegion> probes = {probe_of("upper", {1, 41}, 30, 20), probe_of("zone", {1, 1}, 30, 20)};
    probes[1].is_zone               = true;
    int ratio = 0, anisotropy = 0, direction = 0, found = 0;
    for (int sample = 0; sample < 100; ++sample)
      {
        const GrainNetwork       network = scattered(random, usual_truth(), 32, 64);
        std::vector<ProbeBlocks> blocks  = {probe_blocks(probes[0], network, 5), probe_blocks(probes[1], network, 5)};
        const auto               same    = probe_differences(probes, blocks, {5, 200, 1});
        ASSERT_EQ(same.size(), 1u);
        EXPECT_EQ(same[0].first, "zone");
        EXPECT_EQ(same[0].second, "upper");
        ratio += covers(same[0].t_over_s, 0);
        anisotropy += covers(same[0].anisotropy, 0);
        direction += covers(same[0].direction_deg, 0);

        Truth other = usual_truth();
        other.stress << 2.25, 0.75 * 2.25, 0.75 * 2.25, 2.25;
        blocks[1] = probe_blocks(probes[1], scattered(random, other, 32, 64), 5);
        found += probe_differences(probes, blocks, {5, 200, 1})[0].verdict.rfind("differ: t/s differs", 0) == 0;
      }
    // The binomial scatter is 2.2.
    for (const int n : {ratio, anisotropy, direction})
      EXPECT_GE(n, 88);
    EXPECT_GE(found, 95);
  }

  TEST(ProbeStatistics, VerdictOfNoDifferenceNeedsNarrowIntervals)
  {
    const GrainNetwork             network = synthetic::hexagonal_network(60, 60, usual_truth().stress);
    const std::vector<ProbeRegion> probes  = {probe_of("probe 1", {5, 5}, 40, 20), probe_of("probe 2", {5, 28}, 40, 20)};
    const std::vector<ProbeBlocks> blocks  = {probe_blocks(probes[0], network, 5), probe_blocks(probes[1], network, 5)};
    ProbeMargins                   wide{0.05, 10, 10};
    const auto                     same = probe_differences(probes, blocks, {5, 200, 1}, wide);
    EXPECT_EQ(same[0].first, "probe 1");
    EXPECT_EQ(same[0].verdict.rfind("do not differ", 0), 0u) << same[0].verdict;

    const std::vector<ProbeRegion> few     = {probes[0], probe_of("probe 2", {5, 28}, 9, 9)};
    const auto                     unknown = probe_differences(few, {blocks[0], probe_blocks(few[1], network, 5)}, {5, 200, 1});
    EXPECT_EQ(unknown[0].verdict.rfind("cannot tell", 0), 0u) << unknown[0].verdict;
  }
} // namespace
