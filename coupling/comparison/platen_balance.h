// diptych: how far the normal resultants on the two platens are apart (Moreau 1997)
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>

#include "coupling/statistics/history_table.h"
#include "coupling/statistics/interval.h"

namespace diptych::coupling
{
  // Of (lower + upper) / mean size of the vertical resultants on the sample, which only inertia makes differ from 0.
  struct PlatenBalance
  {
    int      steps                 = 0;   // counted
    double   share_below_1_percent = NAN; // of these steps
    double   largest               = NAN; // size
    Interval mean;                        // signed, batch means of ten runs of steps
  };

  // |lower + upper| / mean size of the two, of every row; NaN where there is no force.
  std::vector<double> platen_differences(const HistoryTable &history);

  // Steps beyond `from` of the progress; columns lower_fy and upper_fy. NaN where there are none.
  PlatenBalance platen_balance(const HistoryTable &history, double from = 0.002);
} // namespace diptych::coupling
