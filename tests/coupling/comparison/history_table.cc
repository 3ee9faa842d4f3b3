// diptych: means over strain from rows at uneven strains
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <filesystem>
#include <fstream>

#include <unistd.h>

#include <gtest/gtest.h>

#include "coupling/comparison/history_table.h"

namespace
{
  using namespace diptych::coupling;

  // y = 10 x at uneven x: the mean over [0.1, 0.4] is 10 * 0.25 however the rows lie.
  TEST(HistoryTable, MeanOfALineDoesNotDependOnItsRows)
  {
    const HistoryTable table = {{"axial_strain", {0, 0.05, 0.07, 0.3, 0.31, 0.5}}, {"y", {0, 0.5, 0.7, 3, 3.1, 5}}};
    EXPECT_NEAR(mean_over_strain(table, "y", 0.1, 0.4), 2.5, 1e-14);
    EXPECT_NEAR(mean_over_strain(table, "y", 0.4, 0.5), 4.5, 1e-14);
  }

  // A hat of height 1 and half width 0.1 about 0.5: the best mean over 0.1 lies symmetrically: 1 - 0.05/2/0.1 = 0.75.
  TEST(HistoryTable, PeakOfTheRunningMean)
  {
    HistoryTable table;
    for (int k = 0; k <= 1000; ++k)
      {
        const double x = 0.001 * k;
        table["axial_strain"].push_back(x);
        table["y"].push_back(std::max(0., 1 - std::abs(x - 0.5) / 0.1));
      }
    const Peak peak = peak_of_running_mean(table, "y", 0.1);
    EXPECT_NEAR(peak.value, 0.75, 1e-3);
    EXPECT_NEAR(peak.axial_strain, 0.55, 2e-3);
  }

  TEST(HistoryTable, ABrokenFileIsNamedWithItsLine)
  {
    const std::string path =
      (std::filesystem::path(testing::TempDir()) / ("history" + std::to_string(::getpid()) + ".csv")).string();
    std::ofstream(path) << "axial_strain,y\n0,1\n0.1\n";
    try
      {
        read_history(path);
        FAIL() << "no error";
      }
    catch (const std::runtime_error &error)
      {
        EXPECT_NE(std::string(error.what()).find("line 3"), std::string::npos) << error.what();
      }
    std::filesystem::remove(path);
    EXPECT_THROW(read_history(path), std::runtime_error);
  }
} // namespace
