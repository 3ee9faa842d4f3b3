// diptych: tests of the intervals of means of correlated series
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/statistics/batch_means.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include "coupling/comparison/platen_balance.h"
#include "tests/coupling/synthetic_samples.h"

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
} // namespace
