// diptych: result files of the continuum panel
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "continuum/snapshot.h"
#include "discrete/files/staged_file.h"
#include "discrete/files/vtu_file.h"

namespace diptych::coupling
{
  // Writes the added snapshots to PATH.h5, PATH.pvd and PATH/stage_NNNN.vtu. continuum/snapshot_fields.h lists names and units.
  // The files are complete after every add(), and no snapshot is written twice. ParaView shows the progress as time. All
  // functions throw std::runtime_error with the name of a file that cannot be written.
  class ContinuumSnapshotFile
  {
  public:
    explicit ContinuumSnapshotFile(const std::string &path_without_ending); // replaces earlier files

    // Appends to the first `kept` snapshots of existing files. Throws std::invalid_argument with the file's name if it has fewer.
    ContinuumSnapshotFile(const std::string &path_without_ending, std::size_t kept);

    // Throws std::invalid_argument if lists of the snapshot differ in length.
    void add(const continuum::Snapshot &snapshot);
    void close(); // joins all stages in one .h5 file

    std::size_t size() const { return stages.size(); }

  private:
    discrete::StagedFile stages;
    discrete::VtuSeries  views;
  };

  // Returns the snapshots with the same bits as they were added. Throws std::invalid_argument with file, stage and array if an
  // array is missing, damaged, of a wrong shape or contradicts another one.
  std::vector<continuum::Snapshot> read_continuum_snapshots(const std::string &h5_path);

  // Number of snapshots in a file; 0 if there is no file.
  std::size_t count_continuum_snapshots(const std::string &h5_path);
} // namespace diptych::coupling
