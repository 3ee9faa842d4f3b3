// diptych: both panels at the same instants, seen through the same operators
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "coupling/bands/theory_lines.h"
#include "coupling/comparison/stage_record.h"
#include "coupling/comparison/summary.h"
#include "coupling/fields/resolution_study.h"
#include "coupling/statistics/history_table.h"
#include "coupling/store/results.h"

namespace diptych::coupling
{
  struct CoarseRun
  {
    double                 element_size = 0; // mean diameters
    std::vector<Increment> windows;          // continuum side only
    Peak                   peak;
  };

  // Everything the report shows, but for the snapshots that it was made of. Lengths in the scene's own unit.
  struct Comparison
  {
    std::vector<StageRecord>   stages; // stage k of both panels' snapshots, from the first on
    std::vector<Increment>     windows;
    std::optional<CoarseRun>   coarse;     // none where there was no such run
    ResolutionStudy            resolution; // of the last stage's grain stress
    std::optional<TheoryLines> theory;     // of the continuum's peak angles; none for an elastic law
    HistoryTable               discrete_history, continuum_history;
    DiscreteSummary            discrete;
    ContinuumSummary           continuum;
    CostSummary                cost;
  };

  // Both panels of one scene, without any solver and without files. Stages that only one panel reached are left out. Throws
  // std::invalid_argument where the panels share no stage beyond the start. `on_progress`, if given, is called with the share
  // that is done before every stage and window; what it throws ends the comparison.
  using OnProgress = std::function<void(double share)>;
  Comparison compare(const Scene &scene, const Results &results, const OnProgress &on_progress = {});
} // namespace diptych::coupling
