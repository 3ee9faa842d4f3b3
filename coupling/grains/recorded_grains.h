// diptych: runs the discrete panel and writes its files
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
  // Runs the discrete panel, writes rows and snapshots to the result folder, and a checkpoint every checkpoint_minutes.
  class RecordedGrains
  {
  public:
    RecordedGrains(const RunOptions &options, const Scene &scene, const std::optional<discrete::StoredCheckpoint> &checkpoint);
    RecordedGrains(const RecordedGrains &)            = delete; // the panel's hooks call this one
    RecordedGrains &operator=(const RecordedGrains &) = delete;

    std::string warnings; // about its snapshots, one per line

    // Rows and, if keeps_snapshots, snapshots that this process computed. After --resume they begin at the checkpoint.
    DiscreteResults results;
    bool            keeps_snapshots = false;

    void                    prepare();                                  // makes the sample, writes no file
    discrete::Snapshot      sample() const { return panel.snapshot(); } // after prepare() and before run()
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
    std::optional<discrete::TableFile>    table; // opened when the sample is prepared
    std::optional<discrete::SnapshotFile> snapshots;
    Clock::time_point                     saved = Clock::now(), flushed = saved;
    bool                                  announced = false, is_prepared = false;
    discrete::Panel                       panel;
  };

  // Hooks of a panel that all processes run. They stop when the first one is asked to.
  discrete::Hooks shared_hooks(discrete::Processes &processes);
} // namespace diptych::coupling
