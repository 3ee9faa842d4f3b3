// diptych: result files of the discrete panel
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "discrete/files/staged_file.h"
#include "discrete/files/xdmf.h"
#include "discrete/snapshot.h"

namespace diptych::discrete
{
  // PATH.h5 with one group stage_NNNN a snapshot (snapshot_fields.h says what is in it) and PATH.xdmf beside it, which ParaView
  // opens: grains, contacts and window forces as points. A snapshot is added without touching those before it.
  class SnapshotFile
  {
  public:
    explicit SnapshotFile(const std::string &path_without_ending);          // begins anew
    SnapshotFile(const std::string &path_without_ending, std::size_t kept); // goes on from the first `kept` snapshots

    void        add(const Snapshot &snapshot);
    void        close(); // one file of all; without it PATH.h5 links files in the folder PATH
    std::size_t size() const { return stages.size(); }

  private:
    void list(const Snapshot &snapshot);

    std::string                 path;
    StagedFile                  stages;
    std::vector<XdmfCollection> collections = {{"grains", {}}, {"contacts", {}}, {"window", {}}};
  };

  // A whole file at once.
  void write_snapshots(const std::string &path_without_ending, const std::vector<Snapshot> &snapshots);

  // Throws std::invalid_argument naming file and dataset where one is missing, damaged, of another length than it must be, not
  // finite or out of range. Window forces and all that the comparison needs are restored.
  std::vector<Snapshot> read_snapshots(const std::string &h5_path);
} // namespace diptych::discrete
