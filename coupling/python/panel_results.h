// diptych: results of a panel, for the Python bindings
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
  // Arrays that view a snapshot share its ownership.
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
