// diptych: both panels at the same instants, seen through the same operators
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "coupling/comparison/history_table.h"
#include "coupling/homogenisation/resolution_study.h"
#include "coupling/comparison/stage_record.h"
#include "coupling/bands/theory_lines.h"

namespace diptych::coupling
{
  struct CoarseRun
  {
    double                 element_size = 0; // mean diameters
    std::vector<Increment> windows;          // continuum side only
    Peak                   peak;
  };

  // Everything the report shows. Lengths in the scene's own unit.
  struct Comparison
  {
    std::vector<StageRecord>         stages;
    std::vector<Increment>           windows;
    CoarseRun                        coarse;
    ResolutionStudy                  resolution; // of the last stage's grain stress
    std::optional<TheoryLines>       theory;     // of the continuum's peak angles; none for an elastic law
    HistoryTable                     discrete_history, continuum_history;
    std::vector<discrete::Snapshot>  grains; // stage 0 first
    std::vector<continuum::Snapshot> nodes;
  };

  // From the files of a result folder, so that a comparison can be made again without any solver: discrete.h5/.csv,
  // continuum.h5/.csv, coarse/continuum.h5/.csv. Stages that only one panel reached are left out.
  // Throws std::runtime_error naming what is missing.
  Comparison compare(const Scene &scene, const std::string &directory);
} // namespace diptych::coupling
