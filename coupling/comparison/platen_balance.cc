// diptych: difference between the normal forces of the two platens (Moreau 1997)
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/comparison/platen_balance.h"

#include <algorithm>
#include <cmath>

#include "coupling/statistics/batch_means.h"

namespace diptych::coupling
{
  std::vector<double> platen_differences(const HistoryTable &history)
  {
    const std::vector<double> &lower = column(history, "lower_fy"), &upper = column(history, "upper_fy");
    std::vector<double>        differences;
    for (std::size_t k = 0; k < lower.size(); ++k)
      {
        const double size = 0.5 * (std::abs(lower[k]) + std::abs(upper[k]));
        differences.push_back(size > 0 ? std::abs(lower[k] + upper[k]) / size : NAN);
      }
    return differences;
  }

  PlatenBalance platen_balance(const HistoryTable &history, const double from)
  {
    const std::vector<double> &progress = column(history, "progress"), &lower = column(history, "lower_fy"),
                              &upper = column(history, "upper_fy");
    std::vector<double> difference;
    PlatenBalance       result;
    double              below = 0, largest = 0;
    for (std::size_t k = 0; k < progress.size(); ++k)
      if (is_beyond(progress[k], from))
        {
          difference.push_back((lower[k] + upper[k]) / (0.5 * (lower[k] - upper[k])));
          below += std::abs(difference.back()) < 0.01;
          largest = std::max(largest, std::abs(difference.back()));
        }
    result.steps = static_cast<int>(difference.size());
    if (difference.empty())
      return result;
    result.share_below_1_percent = below / difference.size();
    result.largest               = largest;
    result.mean                  = batch_mean_interval(difference, std::vector<double>(difference.size(), 1.), 10);
    return result;
  }
} // namespace diptych::coupling
