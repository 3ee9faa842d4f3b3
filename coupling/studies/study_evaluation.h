// diptych: errors of the points of a study against its reference, their classes, orders of convergence
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "coupling/statistics/equivalence.h"
#include "coupling/studies/study_points.h"
#include "coupling/studies/study_results.h"

namespace diptych::coupling
{
  enum class PointClass
  {
    right,          // every quantity with a limit is within it
    wrong_warned,   // beyond a limit, and the program had warned
    silently_wrong, // beyond a limit without a word
    struggled,      // within its limits, after steps were halved
    stopped,        // a run did not come to its end
    refused,        // the settings contradict each other
    unjudged,       // no quantity has a limit
    not_run         // interrupted, or never begun
  };
  constexpr auto choices(PointClass)
  {
    return std::array{std::pair{PointClass::right, "right"},
                      std::pair{PointClass::wrong_warned, "wrong, warned"},
                      std::pair{PointClass::silently_wrong, "silently wrong"},
                      std::pair{PointClass::struggled, "struggled"},
                      std::pair{PointClass::stopped, "stopped"},
                      std::pair{PointClass::refused, "refused"},
                      std::pair{PointClass::unjudged, "unjudged"},
                      std::pair{PointClass::not_run, "not run"}};
  }

  // A quantity at a point: point minus reference, sample by sample.
  struct PointQuantity
  {
    std::vector<double> values; // one a sample; NaN where it has none
    SampleStatistics    statistics;
    Interval            error; // 95 %; relative to the reference's mean where the quantity's errors are
    int                 pairs   = 0;
    double              scatter = NAN; // of one sample about the reference's mean, in the error's unit; NaN below two samples
    std::string         verdict;       // against the limit: within, beyond, cannot tell; empty without a limit
  };

  struct PointRecord
  {
    PointClass                 kind       = PointClass::not_run;
    bool                       is_certain = false;           // the intervals leave no doubt of the class
    std::string                words;                        // of the first run that did not finish
    int                        warned = 0, halved_steps = 0; // runs that warned; steps, of the worst run
    double                     cut_backs = 0;
    std::vector<PointQuantity> quantities;
  };

  // v = limit + coefficient h^order along an axis, all else fixed, fitted to the means over the samples.
  struct OrderRecord
  {
    std::size_t              family = 0, axis = 0, quantity = 0;
    std::vector<std::string> labels; // of the other axes' points; that of this axis is empty
    int                      points = 0;
    Interval                 order, limit; // intervals by leaving out one sample at a time, from three samples on
    double                   coefficient = 0;
  };

  struct StudyRecord
  {
    std::vector<PointRecord> points;
    std::vector<OrderRecord> orders;
  };

  // results[point][sample]
  using StudyResults = std::vector<std::vector<RunResult>>;

  StudyRecord evaluate(const Study &study, const std::vector<ScenePoint> &points, const StudyResults &results);
} // namespace diptych::coupling
