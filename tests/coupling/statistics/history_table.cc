// diptych: tests of means over strain for rows at uneven strains
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "coupling/statistics/history_table.h"

namespace
{
  using namespace diptych::coupling;

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
} // namespace
