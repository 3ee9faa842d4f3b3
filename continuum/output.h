// diptych: result files of the continuum panel
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "continuum/panel.h"
#include "continuum/snapshot.h"

namespace diptych::continuum
{
  // Writes continuum.h5 + continuum.xdmf, continuum.pvd + continuum/stage_NNNN.vtu and continuum.csv into an existing
  // folder. Every file is written under a temporary name and renamed, so that what was reached before a kill is
  // readable. The time shown by ParaView is the axial strain.
  class ResultFiles
  {
  public:
    // Throws std::runtime_error when the folder cannot be written to.
    explicit ResultFiles(const std::string &folder);

    // Appends one stage to all of .h5, .xdmf, .pvd, .vtu and brings the .csv up to date.
    void add(const Snapshot &snapshot);

    // Kept in memory until the next stage or finish().
    void add(const HistoryRow &row);

    // Writes the rows since the last stage.
    void finish() const;

  private:
    std::string              folder;
    std::vector<double>      axial_strains; // of the stages
    std::vector<std::size_t> n_cells, n_nodes;
    std::vector<HistoryRow>  rows;
  };

  // The stages of a continuum.h5, as they were given to ResultFiles. Throws std::runtime_error naming file and group.
  std::vector<Snapshot> read_snapshots(const std::string &h5_file);

  // The pieces, for use on their own. All throw std::runtime_error naming the file.
  void append_to_hdf5(const std::string &h5_file, const Snapshot &snapshot, unsigned int stage);
  void write_vtu(const std::string &vtu_file, const Snapshot &snapshot);
  void write_history(const std::string &csv_file, const std::vector<HistoryRow> &rows);
} // namespace diptych::continuum
