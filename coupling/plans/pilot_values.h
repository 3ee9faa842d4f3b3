// diptych: values of a pilot's samples, relative
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "coupling/statistics/equivalence.h"
#include "coupling/studies/study.h"

namespace diptych::coupling
{
  // Of the samples that have a value (a band, for one). Angles of lines turn, and what they scatter by is relative to 45 degrees.
  struct PilotSummary
  {
    SampleStatistics statistics;    // in the quantity's unit
    double           scatter = NAN; // of one sample, relative; NaN below two
  };
  [[nodiscard]] PilotSummary summary_of(const StudyQuantity &quantity, const std::vector<double> &values);

  // One list less another, sample by sample, relative to the mean of the other, or to 45 degrees.
  [[nodiscard]] SampleStatistics relative_difference(const StudyQuantity       &quantity,
                                                     const std::vector<double> &values,
                                                     const std::vector<double> &others);
} // namespace diptych::coupling
