// diptych: runs the continuum panel and writes its files
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "continuum/panel/panel.h"
#include "coupling/panels/continuum_mesh.h"
#include "coupling/processes/progress.h"
#include "coupling/processes/run_options.h"
#include "coupling/scene/scene.h"
#include "coupling/scene/scene_error.h"
#include "coupling/store/continuum_checkpoint_file.h"
#include "coupling/store/continuum_snapshot_file.h"
#include "coupling/store/results.h"
#include "discrete/files/table_file.h"

namespace diptych::coupling
{
  // Runs the continuum panel, writes rows and snapshots to the part's files, and a checkpoint every checkpoint_minutes. Only
  // the first process writes files. All functions are collective.
  class RecordedContinuum
  {
  public:
    // Only the first process needs `grains`, for the mesh and a mapped stress. `resume`: continues from part.checkpoint(). Throws
    // SceneError if the checkpoint belongs to another scene or mesh, and StoppedOnRequest between phases of the set-up.
    RecordedContinuum(const RunOptions         &options,
                      const Scene              &scene,
                      const ContinuumPart      &part,
                      const discrete::Snapshot *grains,
                      double                    solid_fraction,
                      bool                      resume);
    RecordedContinuum(const RecordedContinuum &)            = delete; // the panel's hooks call this one
    RecordedContinuum &operator=(const RecordedContinuum &) = delete;

    const continuum::Report &run();

    // Rows and, if keeps_snapshots, snapshots that this process computed; on the first process only. After --resume they begin at
    // the checkpoint.
    ContinuumResults results;
    bool             keeps_snapshots = false;

  private:
    using Clock = std::chrono::steady_clock;

    std::string      path(const std::string &name) const { return part.directory + "/" + name; }
    continuum::Hooks hooks();
    void             take_up();
    void             prepare();
    void             add_row(const continuum::HistoryRow &row);
    void             add_snapshot();
    void             flush_rows();
    void             flush_now_and_then();
    void             save();

    const RunOptions                    &options;
    const Scene                         &scene;
    const ContinuumPart                 &part;
    const discrete::Snapshot            *grains;
    continuum::QuadMesh                  mesh;
    continuum::Loading                   loading;
    std::string                          scene_identity, sample_identity;
    Progress                             progress;
    std::optional<discrete::TableFile>   table;
    std::optional<ContinuumSnapshotFile> snapshots;
    Clock::time_point                    saved = Clock::now(), flushed = saved;
    std::unique_ptr<continuum::Panel>    panel;
    bool is_under_way = false; // true once the panel is at rest: from then on it can write a checkpoint
  };
} // namespace diptych::coupling
