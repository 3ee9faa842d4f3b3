// diptych: difference between the normal forces of the two platens (Moreau 1997)
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>

#include "coupling/statistics/history_table.h"
#include "coupling/statistics/interval.h"

namespace diptych::coupling
{
  // Statistics of (lower + upper) / mean size of the vertical forces on the sample. Only inertia makes it differ from 0.
  struct PlatenBalance
  {
    int      steps                 = 0;   // number of steps
    double   share_below_1_percent = NAN; // share of these steps
    double   largest               = NAN; // largest magnitude
    Interval mean;                        // with sign; batch means over ten runs of steps
  };

  // |lower + upper| / mean size of the two forces, for every row; NaN if there is no force.
  std::vector<double> platen_differences(const HistoryTable &history);

  // Uses the steps beyond `from` of the progress, and the columns lower_fy and upper_fy. NaN if there are none.
  PlatenBalance platen_balance(const HistoryTable &history, double from = 0.002);
} // namespace diptych::coupling
