// diptych: the results of both panels of one scene, in memory
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "continuum/history.h"
#include "continuum/snapshot.h"
#include "coupling/store/facts.h"
#include "discrete/panel/history.h"
#include "discrete/snapshot.h"

namespace diptych::coupling
{
  struct DiscreteResults
  {
    std::vector<discrete::HistoryRow> rows;
    std::vector<discrete::Snapshot>   snapshots; // the prepared sample first, then one per stage
    discrete::Report                  facts = unknown_report<discrete::Report>();
  };

  struct ContinuumResults
  {
    std::vector<continuum::HistoryRow> rows;
    std::vector<continuum::Snapshot>   snapshots; // the state at rest first, then one per stage
    continuum::Report                  facts = unknown_report<continuum::Report>();
  };

  // Everything that a comparison needs. It comes from panels that ran in this process or from files; both give the same bits.
  struct Results
  {
    DiscreteResults        discrete;
    ContinuumResults       continuum, coarse; // coarse: on the coarse mesh; empty without a coarse run
    std::vector<PhaseCost> phases;
  };

  // Two stages whose progress differs by less are the same stage.
  constexpr double same_progress = 1e-6;

  // Index of the first snapshot at that progress; none if no stage ends there.
  template <class Snapshot> std::optional<std::size_t> snapshot_at(const std::vector<Snapshot> &snapshots, const double progress)
  {
    for (std::size_t k = 0; k < snapshots.size(); ++k)
      if (std::abs(snapshots[k].progress - progress) < same_progress)
        return k;
    return std::nullopt;
  }

  // Reads a result folder: discrete.h5 and .csv, continuum.h5 and .csv, coarse/continuum.h5 and .csv, provenance.json. Throws
  // std::invalid_argument with the name of a file that is missing, damaged or from another run. Examples: a table without the
  // last step of a stage, a mesh turned inside out. The continuum is read from the folder `of_continuum`.
  Results        load_results(const std::string &folder, const std::string &of_continuum);
  inline Results load_results(const std::string &folder)
  {
    return load_results(folder, folder);
  }
} // namespace diptych::coupling
