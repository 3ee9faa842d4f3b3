// diptych: what a panel made, on the Python side
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>
#include <vector>

#include "continuum/history.h"
#include "continuum/snapshot.h"
#include "discrete/panel/history.h"
#include "discrete/snapshot.h"

namespace diptych::python
{
  // Snapshots are shared with the arrays that look into them.
  using GrainSnapshots     = std::vector<std::shared_ptr<discrete::Snapshot>>;
  using ContinuumSnapshots = std::vector<std::shared_ptr<continuum::Snapshot>>;

  struct GrainResults
  {
    std::vector<discrete::HistoryRow> rows;
    GrainSnapshots                    snapshots;
  };

  struct ContinuumResults
  {
    std::vector<continuum::HistoryRow> rows;
    ContinuumSnapshots                 snapshots;
  };
} // namespace diptych::python
