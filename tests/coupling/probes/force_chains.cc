// diptych: tests of force chains inside and outside a zone, with values of known distribution
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/probes/force_chains.h"
#include "tests/coupling/synthetic_samples.h"

namespace
{
  using namespace diptych::coupling;

  const std::vector<Eigen::Vector2d> box_60 = {{0, 0}, {60, 0}, {60, 60}, {0, 60}};

  // A horizontal zone y = 20 .. 40.
  BandZone zone()
  {
    return {{30, 30}, 0, 10};
  }

  // One grain per unit square. Its moment has the major principal stress value(x) and a third of it as the minor one.
  template <class Value> GrainNetwork grains(const Value &value)
  {
    GrainNetwork network;
    for (int row = 0; row < 60; ++row)
      for (int column = 0; column < 60; ++column)
        {
          network.position.emplace_back(column + 0.5, row + 0.5);
          network.radius.push_back(0.5);
          Eigen::Matrix2d moment = Eigen::Vector2d(value(network.position.back()), 0).asDiagonal();
          moment(1, 1)           = moment(0, 0) / 3;
          network.moment.push_back(moment * M_PI / 4);
        }
    return network;
  }

  double exponential(std::mt19937_64 &random)
  {
    return -std::log(1 - synthetic::uniform(random, 0, 1));
  }

  // Values are a times an exponential variable, with shares 1 - exp(-x/a): a = 1.5 inside and 1 outside. The largest difference
  // is at x = 3 ln 1.5: exp(-2 ln 1.5) - exp(-3 ln 1.5) = 4/9 - 8/27 = 4/27, for any common unit. 1200 values are inside, 2400
  // outside. The scatter is that of Kolmogorov and Smirnov, 1.36 sqrt(1/1200 + 1/2400) = 0.048, times the factor of Student's t
  // for the 48 blocks with a value inside (1.04). It is accurate to the 5 % quantile of 400 resamples (10 %).
  TEST(ForceChains, MeasuresStrongerForcesInside)
  {
    std::mt19937_64    random(1);
    const GrainNetwork network = grains(
      [&](const Eigen::Vector2d &x) { return (zone().holds(x) ? 1.5 : 1) * exponential(random); });
    const ForceChains chains = grain_force_chains(zone(), box_60, network, 0, {5, 400, 1});
    EXPECT_EQ(chains.inside.count, 1200);
    EXPECT_EQ(chains.outside.count, 2400);
    EXPECT_EQ(chains.blocks, 48);
    const double c = 0.5 * (chains.largest_distance.high - chains.largest_distance.low);
    EXPECT_NEAR(c, 0.048 * 1.04, 0.1 * 0.05);
    EXPECT_NEAR(chains.largest_distance.value, 4. / 27, c);
    EXPECT_EQ(chains.verdict.rfind("differs", 0), 0u) << chains.verdict;
    // The means scatter by 1/sqrt(1200) and 1/sqrt(2400), 4 % in the ratio.
    EXPECT_NEAR(chains.inside.mean / chains.outside.mean, 1.5, 0.12);
    // The medians are a ln 2.
    EXPECT_NEAR(chains.inside.values[5] / chains.outside.values[5], 1.5, 0.15);
  }

  // Values are constant over patches of 5 x 5, each patch one draw: 3600 grains, but 144 samples. Kolmogorov's bound for
  // independent grains would find a difference in most such samples. Blocks of the patches' size find one in 5 %, as they should.
  // 100 samples: 5 +- 2.2.
  TEST(ForceChains, PatternThatIgnoresTheZoneRarelyDiffers)
  {
    std::mt19937_64 random(4);
    int             differs = 0, naive = 0;
    for (int sample = 0; sample < 100; ++sample)
      {
        std::vector<double> patch(144);
        for (double &value : patch)
          value = exponential(random);
        const ForceChains chains = grain_force_chains(
          zone(), box_60, grains([&](const Eigen::Vector2d &x) { return patch[int(x.y() / 5) * 12 + int(x.x() / 5)]; }), 0,
          {5, 100, 1});
        differs += chains.verdict.rfind("differs", 0) == 0;
        naive += chains.largest_distance.value > 0.048;
      }
    EXPECT_LE(differs, 11);
    EXPECT_GE(naive, 80);
  }

  TEST(ForceChains, EqualGrainsIgnoreTheZone)
  {
    const ForceChains chains = grain_force_chains(zone(), box_60, grains([](const auto &) { return 2; }), 0, {5, 100, 1});
    EXPECT_EQ(chains.largest_distance.value, 0);
    EXPECT_EQ(chains.largest_distance.high, 0);
    EXPECT_EQ(chains.verdict.rfind("ignores the zone", 0), 0u) << chains.verdict;
    EXPECT_NEAR(chains.inside.mean, 1, 1e-9);
    EXPECT_EQ(chains.inside.share_above_mean, 0);
  }

  // A rim of 2.9 mean diameters is left out: 54 x 54 grains remain, with the rows 20 .. 39 inside.
  TEST(ForceChains, LeavesOutTheRimOfTheSample)
  {
    const ForceChains chains = grain_force_chains(zone(), box_60, grains([](const auto &) { return 2; }), 2.9, {5, 100, 1});
    EXPECT_EQ(chains.inside.count, 20 * 54);
    EXPECT_EQ(chains.inside.count + chains.outside.count, 54 * 54);
  }

  TEST(ForceChains, ZoneOutsideTheSampleGivesNoVerdict)
  {
    const BandZone    beside{{30, 90}, 0, 10};
    const ForceChains chains = grain_force_chains(beside, box_60, grains([](const auto &) { return 2; }), 0, {5, 100, 1});
    EXPECT_EQ(chains.inside.count, 0);
    EXPECT_TRUE(std::isnan(chains.largest_distance.value));
    EXPECT_EQ(chains.verdict.rfind("cannot tell", 0), 0u);
  }
} // namespace
