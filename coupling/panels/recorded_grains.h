// diptych: the discrete panel with its files
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "coupling/processes/progress.h"
#include "coupling/processes/run_options.h"
#include "coupling/scene/scene.h"
#include "coupling/store/results.h"
#include "discrete/files/table_file.h"
#include "discrete/panel/checkpoint.h"
#include "discrete/panel/panel.h"
#include "discrete/panel/snapshot_file.h"

namespace diptych::coupling
{
  // Rows and snapshots go into the folder's files as they come, a checkpoint when it is time.
  class RecordedGrains
  {
  public:
    RecordedGrains(const RunOptions &options, const Scene &scene, const std::optional<discrete::StoredCheckpoint> &checkpoint);
    RecordedGrains(const RecordedGrains &)            = delete; // the panel's hooks call this one
    RecordedGrains &operator=(const RecordedGrains &) = delete;

    std::string     warnings; // of its snapshots, a line each
    DiscreteResults results;  // rows and, if wanted, snapshots, where the run begins in this process
    bool            keeps_snapshots = false;

    void                    prepare();                                  // the sample, without any file
    discrete::Snapshot      sample() const { return panel.snapshot(); } // once it is prepared and not yet loaded
    bool                    is_ready() const { return is_prepared && panel.report().status == discrete::Status::finished; }
    const discrete::Report &run();

  private:
    using Clock = std::chrono::steady_clock;

    std::string     path(const std::string &name) const { return scene.output.directory + "/" + name; }
    int             n_stages() const;
    discrete::Hooks hooks();
    void            begin_files();
    void            announce() const;
    void            add_row(const discrete::HistoryRow &row);
    void            add_snapshot();
    void            before_step();
    void            save();

    const RunOptions                     &options;
    const Scene                          &scene;
    const std::string                     identity;
    Progress                              progress;
    std::optional<discrete::TableFile>    table; // from the prepared sample on
    std::optional<discrete::SnapshotFile> snapshots;
    Clock::time_point                     saved = Clock::now(), flushed = saved;
    bool                                  announced = false, is_prepared = false;
    discrete::Panel                       panel;
  };
} // namespace diptych::coupling
