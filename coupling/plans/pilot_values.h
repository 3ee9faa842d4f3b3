// diptych: relative values and differences of a pilot's samples
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "coupling/statistics/equivalence.h"
#include "coupling/studies/study.h"

namespace diptych::coupling
{
  // Uses the samples that have a value (for example a band). For the angle of a line, the scatter is relative to 45 degrees.
  struct PilotSummary
  {
    SampleStatistics statistics;    // in the quantity's unit
    double           scatter = NAN; // of one sample, relative; NaN below two
  };
  [[nodiscard]] PilotSummary summary_of(const StudyQuantity &quantity, const std::vector<double> &values);

  // Differences values - others, sample by sample, relative to the mean of the others, or to 45 degrees.
  [[nodiscard]] SampleStatistics relative_difference(const StudyQuantity       &quantity,
                                                     const std::vector<double> &values,
                                                     const std::vector<double> &others);
} // namespace diptych::coupling
