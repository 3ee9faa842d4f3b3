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
    right,          // every quantity is within its limit
    wrong_warned,   // a limit is exceeded, and a panel warned
    silently_wrong, // a limit is exceeded without a warning
    struggled,      // within the limits, but steps were halved
    stopped,        // a run did not finish
    refused,        // the settings contradict each other
    unjudged,       // no quantity has a limit
    not_run         // interrupted or never started
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
    std::vector<double> values; // one per sample; NaN if it has none
    SampleStatistics    statistics;
    Interval            error; // 95 %; relative to the reference's mean if is_relative
    int                 pairs   = 0;
    double              scatter = NAN; // of one sample, in the unit of the error; NaN below two samples
    std::string         verdict;       // within, beyond or cannot tell; empty without a limit
  };

  struct PointRecord
  {
    PointClass                 kind       = PointClass::not_run;
    bool                       is_certain = false;           // the intervals confirm the class
    std::string                words;                        // message of the first run that did not finish
    int                        warned = 0, halved_steps = 0; // runs that warned; halved steps of the worst run
    double                     cut_backs = 0;
    std::vector<PointQuantity> quantities;
  };

  // v = limit + coefficient h^order along one axis, with all other settings fixed. Fitted to the means over the samples.
  struct OrderRecord
  {
    std::size_t              family = 0, axis = 0, quantity = 0;
    std::vector<std::string> labels; // of the points on the other axes; the entry of this axis is empty
    int                      points = 0;
    Interval                 order, limit; // intervals from leaving out one sample at a time; at least three samples
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
