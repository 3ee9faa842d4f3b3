// diptych: tests of intervals from resampled blocks
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/statistics/student.h"
#include "coupling/statistics/block_bootstrap.h"

#include <numeric>
#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/coupling/synthetic_samples.h"

namespace
{
  using namespace diptych::coupling;

  TEST(BlockBootstrap, TilesAreAtLeastABlockWideAndHoldEachPointOnce)
  {
    // 23 x 11 rotated by 30 degrees: four columns of 5.75, two rows of 5.5.
    const double          c = std::cos(M_PI / 6), s = std::sin(M_PI / 6);
    const Eigen::Vector2d along(c, s), across(-s, c), corner(3, -4);
    const Tiles tiles = tiles_over({corner, corner + 23 * along, corner + 23 * along + 11 * across, corner + 11 * across}, 30, 5);
    EXPECT_EQ(tiles.columns, 4);
    EXPECT_EQ(tiles.rows, 2);
    std::vector<int> count(tiles.count(), 0);
    for (int a = 0; a < 40; ++a)
      for (int b = 0; b < 40; ++b)
        ++count[tiles.tile(corner + (a + 0.5) / 40 * 23 * along + (b + 0.5) / 40 * 11 * across)];
    for (const int n : count)
      EXPECT_EQ(n, 200);
    EXPECT_EQ(tiles.tile(corner - 5 * along - 5 * across), 0);
    EXPECT_EQ(tiles_over({{0, 0}, {20, 0}, {20, 3}, {0, 3}}, 0, 5).count(), 4); // 20 is exactly four blocks
    EXPECT_THROW(tiles_over({}, 0, 5), std::invalid_argument);
  }

  // 1e9 x 1e9 blocks of side 1 in a square of side 1e9.
  TEST(BlockBootstrap, RejectsMoreTilesThanMemoryHolds)
  {
    EXPECT_THROW(tiles_over({{0, 0}, {1e9, 0}, {1e9, 1e9}, {0, 1e9}}, 0, 1), std::invalid_argument);
  }

  TEST(BlockBootstrap, EveryResampleHoldsAsManyBlocksAsThereAre)
  {
    const auto drawn = resampled_blocks(7, {5, 2000, 3});
    ASSERT_EQ(drawn.size(), 2000u);
    std::vector<int> total(7, 0);
    for (const auto &times : drawn)
      {
        EXPECT_EQ(std::accumulate(times.begin(), times.end(), 0), 7);
        for (int k = 0; k < 7; ++k)
          total[k] += times[k];
      }
    // Binomial: 14000 draws of probability 1/7 give 2000 +- 41.
    for (const int n : total)
      EXPECT_NEAR(n, 2000, 4 * 41);
    EXPECT_EQ(drawn, resampled_blocks(7, {5, 2000, 3}));
    EXPECT_NE(drawn, resampled_blocks(7, {5, 2000, 4}));
    EXPECT_TRUE(resampled_blocks(3, {5, 2000, 3}).empty());
    EXPECT_TRUE(resampled_blocks(7, {5, 0, 3}).empty());
  }

  // Means of n normal blocks: Student's interval covers the truth in 95 %, +- 0.7 % for 1000 samples. The resampled mean of a
  // small number of blocks has shorter tails than a normal one, which costs up to 2 %.
  TEST(BlockBootstrap, StretchedIntervalOfAMeanCoversTheTruth)
  {
    for (const int n : {4, 8, 20})
      {
        std::mt19937_64 random(17);
        const auto      drawn   = resampled_blocks(n, {5, 400, 1});
        const double    factor  = small_sample_factor(n);
        int             covered = 0;
        for (int sample = 0; sample < 1000; ++sample)
          {
            std::vector<double> block(n);
            for (double &x : block)
              x = synthetic::normal(random);
            const double        mean = std::accumulate(block.begin(), block.end(), 0.) / n;
            std::vector<double> deviations;
            for (const auto &times : drawn)
              deviations.push_back(factor * (std::inner_product(block.begin(), block.end(), times.begin(), 0.) / n - mean));
            const Interval interval = interval_from(mean, deviations);
            covered += interval.low < 0 && interval.high > 0;
          }
        EXPECT_GE(covered, 920) << n << " blocks";
        EXPECT_LE(covered, 975) << n << " blocks";
      }
  }

  // t(3) = 3.182446 and t(9) = 2.262157 (tables); sqrt(4/3) 3.182446 / 1.959964 = 1.874918.
  TEST(BlockBootstrap, FactorForFewBlocks)
  {
    EXPECT_NEAR(student_quantile(0.975, 3), 3.182446, 1e-6);
    EXPECT_NEAR(student_quantile(0.975, 9), 2.262157, 1e-6);
    EXPECT_NEAR(small_sample_factor(4), 1.874918, 1e-6);
    EXPECT_TRUE(std::isnan(small_sample_factor(3)));
  }

  // 2 x 2 blocks with the influences 1, 1, -1, -1 (sum 0): squares 4, the six pairs give 1 + 1 - 4 = -2, chance -4/3 * 6/4. The
  // variance factor is 1 + 2 (-2/4 + 6/12) = 1. A row of 8 with four times 1 and four times -1: products along the row 3 - 1 + 3
  // = 5 of squares 8, seven pairs: 1 + 2 (5/8 + 7/56) = 2.5.
  TEST(BlockBootstrap, NeighboursThatAgreeStretchTheDeviations)
  {
    const auto e = [](const double x) { return Eigen::Vector3d(0, x, 0); };
    EXPECT_NEAR(neighbour_factor({e(1), e(1), e(-1), e(-1)}, {{0, 0}, {1, 0}, {0, 1}, {1, 1}}), 1, 1e-14);
    std::vector<Eigen::Vector3d> influence;
    std::vector<Eigen::Vector2i> place;
    for (int k = 0; k < 8; ++k)
      {
        influence.push_back(e(k < 4 ? 1 : -1));
        place.emplace_back(k, 3);
      }
    EXPECT_NEAR(neighbour_factor(influence, place), std::sqrt(2.5), 1e-14);
    for (int k = 0; k < 8; ++k)
      influence[k] = e(k % 2 ? 1 : -1); // neighbours are opposite
    EXPECT_EQ(neighbour_factor(influence, place), 1);
    EXPECT_EQ(neighbour_factor({}, {}), 1);
  }

  TEST(BlockBootstrap, QuantilesOfDeviationsAreTheEnds)
  {
    std::vector<double> deviations(201);
    for (int k = 0; k < 201; ++k)
      deviations[k] = 0.1 * (k - 100);
    const Interval interval = interval_from(5, deviations);
    EXPECT_NEAR(interval.low, 5 - 9.5, 1e-12);
    EXPECT_NEAR(interval.high, 5 + 9.5, 1e-12);
    std::fill_n(deviations.begin(), 30, NAN); // more than a tenth
    EXPECT_TRUE(std::isnan(interval_from(5, deviations).low));
    EXPECT_EQ(interval_from(5, {}).value, 5);
    EXPECT_TRUE(std::isnan(interval_from(5, {}).high));
  }
} // namespace
