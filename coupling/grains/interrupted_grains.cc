// diptych: checks the files of an interrupted run of the grains before --resume changes anything
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/grains/interrupted_grains.h"

#include <filesystem>
#include <stdexcept>

#include "coupling/scene/scene_error.h"
#include "coupling/store/file_names.h"
#include "coupling/store/provenance.h"
#include "discrete/files/table_file.h"
#include "discrete/panel/history.h"
#include "discrete/panel/snapshot_file.h"

namespace diptych::coupling
{
  void check_stage_count(const std::string &file, const std::size_t found, const std::size_t needed)
  {
    if (found < needed)
      throw std::invalid_argument(file + ": holds " + std::to_string(found) + " stages, not the " + std::to_string(needed) +
                                  " that the checkpoint beside it goes on from");
  }

  std::optional<discrete::StoredCheckpoint> interrupted_grains(const std::string &directory, const std::string &sample)
  {
    const std::string path = grain_checkpoint(directory);
    if (!std::filesystem::exists(path))
      return std::nullopt;
    discrete::StoredCheckpoint checkpoint = discrete::read_checkpoint(path);
    if (checkpoint.scene != sample)
      throw SceneError("--resume: " + path + " belongs to another scene: the sections sample, loading or discrete differ");
    return checkpoint;
  }

  bool grains_are_finished(const std::string &directory)
  {
    return read_run_facts(directory).discrete.finished && std::filesystem::exists(discrete_h5(directory));
  }

  void check_earlier_grains(const std::string &directory, const std::string &sample)
  {
    const bool        finished = grains_are_finished(directory);
    const auto        found    = interrupted_grains(directory, sample);
    const std::string rows = discrete_csv(directory), snapshots = discrete_h5(directory);
    if (!found && !finished)
      return;
    const std::size_t n_snapshots = discrete::read_snapshots(snapshots).size();
    if (!found || found->n_rows > 0) // a run stopped before its first step has no row
      (void)discrete::read_history<discrete::HistoryRow>(rows);
    check_files(directory, "discrete");
    if (!found)
      return;
    discrete::check_table(rows, discrete::csv_header<discrete::HistoryRow>(), found->n_rows);
    check_stage_count(snapshots, n_snapshots, std::size_t(found->panel.stage) + 1);
  }
} // namespace diptych::coupling
