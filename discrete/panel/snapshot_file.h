// diptych: result files of the discrete panel
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "discrete/files/staged_file.h"
#include "discrete/files/vtu_file.h"
#include "discrete/snapshot.h"

namespace diptych::discrete
{
  // PATH.h5 has one group stage_NNNN per snapshot (fields: snapshot_fields.h). For ParaView, PATH.pvd lists the grains of all
  // stages and PATH_contacts.pvd the contact forces (snapshot_views.h). Adding a snapshot does not touch the earlier ones.
  class SnapshotFile
  {
  public:
    explicit SnapshotFile(const std::string &path_without_ending);          // starts a new file
    SnapshotFile(const std::string &path_without_ending, std::size_t kept); // continues after the first `kept` snapshots

    void        add(const Snapshot &snapshot);
    void        close(); // joins all stages in one file; before that PATH.h5 links files in the folder PATH
    std::size_t size() const { return stages.size(); }

  private:
    StagedFile stages;
    VtuSeries  grains, contacts;
  };

  void write_snapshots(const std::string &path_without_ending, const std::vector<Snapshot> &snapshots);

  // Throws std::invalid_argument with file and dataset if a dataset is missing, damaged, not finite, out of range or too short.
  std::vector<Snapshot> read_snapshots(const std::string &h5_path);
} // namespace diptych::discrete
