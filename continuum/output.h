// diptych: result files of the continuum panel
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "continuum/panel.h"
#include "continuum/snapshot.h"

namespace diptych::continuum
{
  // What the files say about a stage without its fields.
  struct StageSummary
  {
    double      axial_strain = 0;
    std::size_t n_cells = 0, n_nodes = 0; // they may differ from stage to stage
    bool        has_rotation = false;
  };

  // Writes continuum.h5 + continuum.xdmf, continuum.pvd + continuum/stage_NNNN.vtu and continuum.csv into an existing
  // folder. Every file is written under a temporary name and renamed, so that what was reached before a kill is
  // readable. The time shown by ParaView is the axial strain. Units, signs and names of the fields are those of Snapshot and
  // CellState: tensors of 9 components row by row, positive in compression; vectors of 3 components, the last one 0.
  class ResultFiles
  {
  public:
    // Throws std::runtime_error when the folder cannot be written to.
    explicit ResultFiles(const std::string &folder);

    // Goes on from the files of an interrupted run: takes over its rows and stages up to axial_strain = resume_from (1e-12
    // relative) and drops later ones. With `only` (the loading's stages) a snapshot at none of them is dropped, too: the one an
    // early end left. Throws std::runtime_error naming a file that is missing or cannot be read.
    ResultFiles(const std::string &folder, double resume_from, const std::vector<double> &only = {});

    // Appends one stage to all of .h5, .xdmf, .pvd and .vtu. The whole .h5 is copied for it: quadratic in the stages.
    void add(const Snapshot &snapshot);

    // Appends a row to the .csv, at once: a checkpoint that follows relies on it.
    void add(const HistoryRow &row);

    // Writes the .csv even if there is no row.
    void finish() const;

  private:
    void take_over_stages(double resume_from, const std::vector<double> &only);
    void list_stages() const;

    std::string               folder;
    std::vector<StageSummary> stages;
    std::vector<HistoryRow>   rows;
  };

  // The stages of a continuum.h5, bit by bit as they were given to ResultFiles. Throws std::runtime_error naming the file, and
  // stage and dataset where one is missing or unreadable.
  std::vector<Snapshot> read_snapshots(const std::string &h5_file);

  // The rows of a continuum.csv, bit by bit as they were given to ResultFiles (but NaN is any NaN); columns are found by name.
  // Throws std::runtime_error naming file, line and column.
  std::vector<HistoryRow> read_history(const std::string &csv_file);

  // The pieces, for use on their own. All throw std::runtime_error naming the file.
  //
  // Stage 0 makes the file anew. Throws std::invalid_argument for lists of the snapshot that differ in length.
  void append_to_hdf5(const std::string &h5_file, const Snapshot &snapshot, unsigned int stage);
  void write_vtu(const std::string &vtu_file, const Snapshot &snapshot);
  void write_history(const std::string &csv_file, const std::vector<HistoryRow> &rows);

  std::vector<StageSummary> read_stage_summaries(const std::string &h5_file);
  Snapshot                  read_snapshot(const std::string &h5_file, unsigned int stage);

  // Keeps the stages with these numbers, ascending, and renumbers them from 0; no stage: removes the file.
  void keep_stages(const std::string &h5_file, const std::vector<unsigned int> &kept);
} // namespace diptych::continuum
