// diptych: result files of the continuum panel
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "continuum/snapshot.h"
#include "coupling/store/vtu_file.h"
#include "discrete/files/staged_file.h"
#include "discrete/files/xdmf.h"

namespace diptych::coupling
{
  // PATH.h5, PATH.xdmf, PATH.pvd and PATH/stage_NNNN.vtu of the snapshots that are added, names and units as
  // continuum/snapshot_fields.h lists them. Complete after every add() and O(new): a snapshot that is written is not written
  // again. The time that ParaView shows is the progress. All throw std::runtime_error naming a file that cannot be written.
  class ContinuumSnapshotFile
  {
  public:
    explicit ContinuumSnapshotFile(const std::string &path_without_ending); // begins anew

    // Goes on after the first `kept` snapshots of files that stand there. Throws std::invalid_argument naming the file where it
    // has fewer.
    ContinuumSnapshotFile(const std::string &path_without_ending, std::size_t kept);

    // Throws std::invalid_argument for lists of the snapshot that differ in length.
    void add(const continuum::Snapshot &snapshot);
    void close(); // makes one .h5 of all

    std::size_t size() const { return stages.size(); }

  private:
    void list(const continuum::Snapshot &snapshot);

    std::string              path;
    discrete::StagedFile     stages;
    discrete::XdmfCollection collection;
    std::vector<PvdEntry>    views;
  };

  // Bit by bit as they were added. Throws std::invalid_argument naming file, stage and array where one is missing, damaged, of
  // another shape or contradicts another.
  std::vector<continuum::Snapshot> read_continuum_snapshots(const std::string &h5_path);

  // How many a file holds; 0 where there is none.
  std::size_t count_continuum_snapshots(const std::string &h5_path);
} // namespace diptych::coupling
