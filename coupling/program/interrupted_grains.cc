// diptych: what --resume finds of interrupted grains, looked at before anything is changed
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/interrupted_grains.h"

#include <filesystem>
#include <stdexcept>

#include "coupling/folders/provenance.h"
#include "coupling/scene/identity.h"
#include "coupling/scene/scene_error.h"
#include "discrete/files/table_file.h"
#include "discrete/panel/history.h"
#include "discrete/panel/snapshot_file.h"

namespace diptych::coupling
{
  std::string checkpoint_file(const Scene &scene)
  {
    return scene.output.directory + "/checkpoint.h5";
  }

  void check_stage_count(const std::string &file, const std::size_t found, const std::size_t needed)
  {
    if (found < needed)
      throw std::invalid_argument(file + ": holds " + std::to_string(found) + " stages, not the " + std::to_string(needed) +
                                  " that the checkpoint beside it goes on from");
  }

  std::optional<discrete::StoredCheckpoint> interrupted_grains(const Scene &scene)
  {
    (void)read_run_facts(scene.output.directory);
    const std::string path = checkpoint_file(scene);
    if (!std::filesystem::exists(path))
      return std::nullopt;
    discrete::StoredCheckpoint checkpoint = discrete::read_checkpoint(path);
    if (checkpoint.scene != text_of(sample_identity(scene)))
      throw SceneError("--resume: " + path + " belongs to another scene: the sections sample, loading or discrete differ");
    discrete::check_table(scene.output.directory + "/discrete.csv", discrete::csv_header<discrete::HistoryRow>(),
                          checkpoint.n_rows);
    const std::string snapshots = scene.output.directory + "/discrete.h5";
    check_stage_count(snapshots, discrete::read_snapshots(snapshots).size(), std::size_t(checkpoint.panel.stage) + 1);
    return checkpoint;
  }
} // namespace diptych::coupling
