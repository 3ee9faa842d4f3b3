// diptych: tests of means over strain, and of intervals from batches and from resampled blocks
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/statistics/batch_means.h"
#include "coupling/comparison/platen_balance.h"
#include "coupling/statistics/history_table.h"
#include "coupling/statistics/student.h"
#include "coupling/statistics/block_bootstrap.h"
#include "tests/coupling/synthetic_samples.h"
#include "tests/common.h"

namespace
{
  using namespace diptych::coupling;

  // x_{k+1} = phi x_k + sqrt(1 - phi^2) normal, with mean 0, stationary from the start.
  std::vector<double> autoregressive(std::mt19937_64 &random, const int n, const double phi)
  {
    std::vector<double> x(n);
    x[0] = synthetic::normal(random);
    for (int k = 1; k < n; ++k)
      x[k] = phi * x[k - 1] + std::sqrt(1 - phi * phi) * synthetic::normal(random);
    return x;
  }

  double coverage(const int length, const double correlation_length, const int n_batches)
  {
    std::mt19937_64 random(23);
    int             covered = 0;
    for (int sample = 0; sample < 1000; ++sample)
      {
        const auto     x = autoregressive(random, length, std::exp(-1 / correlation_length));
        const Interval i = batch_mean_interval(x, std::vector<double>(length, 1.), n_batches);
        covered += i.low < 0 && i.high > 0;
      }
    return covered / 1000.;
  }

  // Batches ten correlation lengths long are independent: 95 %, binomial scatter 0.7 %. Four batches of 100 values with a
  // correlation length of 15 (1.7 correlation lengths per batch) are not: the widening keeps a coverage that would otherwise be
  // 0.87.
  TEST(BatchMeans, IntervalCoversTheMeanOfAnAutocorrelatedSeries)
  {
    EXPECT_NEAR(coverage(1000, 10, 10), 0.95, 0.02);
    EXPECT_NEAR(coverage(400, 10, 4), 0.95, 0.025);
    EXPECT_GE(coverage(100, 15, 4), 0.88);
  }

  // Batches 1, 2, 3 with the weights of their values: mean 2, s = 1, lag-one correlation (-1*0 + 0*1)/2 + 1/3. Therefore half =
  // t(2) sqrt(1/3) sqrt((4/3)/(2/3)) = 4.302653 * 0.816497.
  TEST(BatchMeans, AreWeightedAndWidenedByTheirOwnCorrelation)
  {
    const Interval i = batch_mean_interval({0, 2, 2, 2, 3}, {1, 1, 1, 1, 2}, 3);
    EXPECT_NEAR(i.value, 2, 1e-14);
    EXPECT_NEAR(i.high - 2, 4.302653 * std::sqrt(2. / 3), 1e-5);
    EXPECT_NEAR(2 - i.low, i.high - 2, 1e-14);
  }

  TEST(BatchMeans, TooFewValuesGiveNoInterval)
  {
    const Interval i = batch_mean_interval({1, 2}, {1, 1}, 4);
    EXPECT_EQ(i.value, 1.5);
    EXPECT_TRUE(std::isnan(i.low));
    EXPECT_TRUE(std::isnan(batch_mean_interval({1, 2, 3}, {1, 1, 1}, 2).low));
    EXPECT_THROW(batch_mean_interval({1, 2}, {1}, 4), std::invalid_argument);
    EXPECT_THROW(batch_mean_interval({1, 2}, {1, -1}, 4), std::invalid_argument);
    EXPECT_THROW(batch_mean_interval({1, 2}, {1, 1}, 0), std::invalid_argument);
    const Interval constant = batch_mean_interval(std::vector<double>(40, 0.3), std::vector<double>(40, 1.), 4);
    EXPECT_NEAR(constant.high, constant.low, 1e-14);
  }

  // A straight line from 0 to 1 over the strain 0 .. 1 has the quarters 0.125, 0.375, ... and s^2 = 5/48. The lag-one correlation
  // is (0.046875 - 0.015625 + 0.046875)/0.3125 + 1/4 = 0.5. The value is that of mean_over_progress().
  TEST(BatchMeans, BatchesOfAHistoryHaveEqualStrain)
  {
    HistoryTable table;
    for (int k = 0; k <= 40; ++k)
      {
        const double strain = std::pow(k / 40., 1.5); // uneven rows
        table["progress"].push_back(strain);
        table["x"].push_back(strain);
      }
    const Interval i = mean_interval_over_progress(table, "x", 0, 1);
    EXPECT_NEAR(i.value, 0.5, 1e-12);
    EXPECT_NEAR(i.high - i.value, 3.182446 * std::sqrt(5. / 48 / 4 * 1.5 / 0.5), 1e-6);
    EXPECT_TRUE(std::isnan(mean_interval_over_progress(table, "x", 0, 0.01).low)); // two rows
  }

  // lower + upper = -0.02, 0.002 and 0.002 of 10: 0.2 %, 0.02 %, ... The step before 0.2 % strain does not count.
  TEST(PlatenBalance, CountsStepsAfterTheStart)
  {
    HistoryTable table;
    for (int k = 0; k < 40; ++k)
      {
        table["progress"].push_back(0.001 + 0.002 * k);
        table["lower_fy"].push_back(10);
        table["upper_fy"].push_back(k == 0 ? -5 : (k % 4 == 0 ? -10.5 : -9.995));
      }
    const PlatenBalance balance = platen_balance(table);
    EXPECT_EQ(balance.steps, 39);
    EXPECT_NEAR(balance.share_below_1_percent, 30. / 39, 1e-12);
    EXPECT_NEAR(balance.largest, 0.5 / 10.25, 1e-12);
    EXPECT_NEAR(balance.mean.value, (30 * 0.005 / 9.9975 - 9 * 0.5 / 10.25) / 39, 1e-12);
    EXPECT_LT(balance.mean.low, balance.mean.value);
    EXPECT_EQ(platen_balance({{"progress", {0.001}}, {"lower_fy", {1}}, {"upper_fy", {-1}}}).steps, 0);
  }

  // For y = 10 x at uneven x the mean over [0.1, 0.4] is 10 * 0.25, whatever the places of the rows.
  TEST(HistoryTable, MeanOfALineDoesNotDependOnItsRows)
  {
    const HistoryTable table = {{"progress", {0, 0.05, 0.07, 0.3, 0.31, 0.5}}, {"y", {0, 0.5, 0.7, 3, 3.1, 5}}};
    EXPECT_NEAR(mean_over_progress(table, "y", 0.1, 0.4), 2.5, 1e-14);
    EXPECT_NEAR(mean_over_progress(table, "y", 0.4, 0.5), 4.5, 1e-14);
  }

  // A hat of height 1 and half width 0.1 about 0.5. The best mean over 0.1 is symmetric: 1 - 0.05/2/0.1 = 0.75.
  TEST(HistoryTable, PeakOfTheRunningMean)
  {
    HistoryTable table;
    for (int k = 0; k <= 1000; ++k)
      {
        const double x = 0.001 * k;
        table["progress"].push_back(x);
        table["y"].push_back(std::max(0., 1 - std::abs(x - 0.5) / 0.1));
      }
    const Peak peak = peak_of_running_mean(table, "y", 0.1);
    EXPECT_NEAR(peak.value, 0.75, 1e-3);
    EXPECT_NEAR(peak.progress, 0.55, 2e-3);
  }

  // A running mean equals the mean over each row's last width. It reads a tenth of the rows that a loop over windows would read
  // and gives the same numbers.
  TEST(HistoryTable, RunningMeanIsTheMeanOfEveryWindow)
  {
    HistoryTable table;
    double       x = 0;
    for (int k = 0; k < 300; ++k)
      {
        x += 0.001 * (1 + k % 7);
        table["progress"].push_back(x);
        table["y"].push_back(std::sin(20 * x) + (k % 2 ? 0.3 : -0.3));
      }
    const std::vector<double> mean = running_mean(table, "y", 0.05);
    ASSERT_EQ(mean.size(), 300u);
    for (std::size_t k = 0; k < mean.size(); ++k)
      {
        const double to = table["progress"][k];
        if (to < 0.05)
          EXPECT_TRUE(std::isnan(mean[k])) << k;
        else
          EXPECT_NEAR(mean[k], mean_over_progress(table, "y", to - 0.05, to), 1e-12) << k;
      }
  }

  // Two halves of a history, with t = 1, s = 4 and with t = 3, s = 6: T/S = 2/5, but the mean of t/s is 3/8.
  TEST(HistoryTable, RatioOfMeansIsNotTheMeanOfTheRatio)
  {
    const double       inch = 1e-12;
    const HistoryTable table{{"progress", {0, 0.5, 0.5 + inch, 1}},
                             {"sxx", {3, 3, 6, 6}},
                             {"syy", {5, 5, 6, 6}},
                             {"sxy", {0, 0, 4, 4}},
                             {"syx", {0, 0, 2, 2}}};
    EXPECT_NEAR(ratio_of_means(table, 0, 0.5), 0.25, 1e-9);
    EXPECT_NEAR(ratio_of_means(table, 0.5 + inch, 1), 0.5, 1e-9);
    EXPECT_NEAR(ratio_of_means(table, 0, 1), 0.4, 1e-9);
    EXPECT_TRUE(std::isnan(ratio_of_means(table, 0, 1.1))) << "the history ends before";
    HistoryTable symmetric = table;
    symmetric["sxy"]       = {0, 0, 3, 3};
    symmetric.erase("syx");
    EXPECT_NEAR(ratio_of_means(symmetric, 0, 1), 0.4, 1e-9);
  }

  // 0.1 + 0.2 is not 0.3, but must not count as beyond it.
  TEST(HistoryTable, RoundingErrorsAreNotBeyond)
  {
    EXPECT_FALSE(is_beyond(0.1 + 0.2, 0.3));
    EXPECT_FALSE(is_beyond(0, 0));
    EXPECT_TRUE(is_beyond(1e-12, 0));
    EXPECT_TRUE(is_beyond(0.3001, 0.3));
  }

  struct Row
  {
    int         step;
    double      force;
    std::string words;
  };
  template <class Visit> void visit_columns(const Row &row, Visit &&visit)
  {
    visit("step", row.step, "-", "");
    visit("force", row.force, "pressure length", "");
    visit("words", row.words, "-", "");
  }

  TEST(HistoryTable, HoldsTheNumbersOfRows)
  {
    const HistoryTable table = history_table(std::vector<Row>{{1, 0.5, "a"}, {2, 0.25, "b"}});
    EXPECT_EQ(table, (HistoryTable{{"step", {1, 2}}, {"force", {0.5, 0.25}}}));
    EXPECT_THROW((void)column(table, "words"), std::invalid_argument);
  }

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
    EXPECT_THROW(tiles_over({{0, 0}, {1e9, 0}, {1e9, 1e9}, {0, 1e9}}, 0, 1), std::invalid_argument) << "more than memory holds";
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
