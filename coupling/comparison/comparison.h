// diptych: comparison of both panels at the same instants, with the same operators
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <optional>
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
    double                 element_size = 0; // in mean diameters
    std::vector<Increment> windows;          // with the continuum's part only
    Peak                   peak;
  };

  // The mapping of a stage may miss the grains' total by this much; beyond it a comparison ends with exit code 1.
  constexpr double largest_error_of_the_total = 1e-12;

  // All results that the report shows, without the snapshots behind them. Lengths are in the scene's unit.
  struct Comparison
  {
    std::vector<StageRecord>   stages; // stage k of both panels' snapshots, beginning with the first
    std::vector<Increment>     windows;
    std::optional<CoarseRun>   coarse;     // empty without a coarse run
    ResolutionStudy            resolution; // of the last stage's grain stress
    std::optional<TheoryLines> theory;     // from the continuum's peak angles; empty for laws without
    HistoryTable               discrete_history, continuum_history;
    DiscreteSummary            discrete;
    ContinuumSummary           continuum;
    PlatenParts                discrete_platens, continuum_platens; // over all stages; empty along time
    CostSummary                cost;
  };

  // Compares both panels of one scene, without a solver and without files. Stages that only one panel reached are left out.
  // Throws std::invalid_argument if the panels share no stage beyond the start. `on_progress`, if given, is called before every
  // stage and window with the share of the work that is done. An exception from it ends the comparison.
  using OnProgress = std::function<void(double share)>;
  Comparison compare(const Scene &scene, const Results &results, const OnProgress &on_progress = {});
} // namespace diptych::coupling
