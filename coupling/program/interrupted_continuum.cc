// diptych: what --resume finds of an interrupted continuum, looked at before anything is changed
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/interrupted_continuum.h"

#include <filesystem>

#include "continuum/history.h"
#include "coupling/files/continuum_checkpoint_file.h"
#include "coupling/files/continuum_snapshot_file.h"
#include "coupling/folders/provenance.h"
#include "coupling/panels/continuum_mesh.h"
#include "coupling/program/interrupted_grains.h"
#include "coupling/scene/identity.h"
#include "coupling/scene/scene_error.h"
#include "discrete/files/table_file.h"

namespace diptych::coupling
{
  namespace
  {
    void check_results(const ContinuumPart &part)
    {
      (void)discrete::read_history<continuum::HistoryRow>(part.directory + "/continuum.csv");
      (void)read_continuum_snapshots(part.directory + "/continuum.h5");
    }

    void check_interrupted(const Scene &scene, const ContinuumPart &part)
    {
      const ContinuumCheckpoint checkpoint = read_continuum_checkpoint(part.checkpoint());
      if (checkpoint.scene != text_of(continuum_identity(scene)))
        throw SceneError("--resume: " + part.checkpoint() + " belongs to another scene");
      if (scene.continuum.mesh.kind != continuum::MeshOption::Kind::outline &&
          checkpoint.sample != identity_of(mesh_of(scene, part, nullptr)))
        throw SceneError("--resume: " + part.checkpoint() + " belongs to another mesh");
      discrete::check_table(part.directory + "/continuum.csv", discrete::csv_header<continuum::HistoryRow>(), checkpoint.n_rows);
      const std::string snapshots = part.directory + "/continuum.h5";
      check_stage_count(snapshots, read_continuum_snapshots(snapshots).size(), std::size_t(checkpoint.panel.stage) + 1);
    }
  } // namespace

  void check_earlier_continuum(const Scene &scene)
  {
    const RunFacts facts = read_run_facts(scene.output.directory);
    for (const ContinuumPart &part : continuum_parts(scene))
      if (std::filesystem::exists(part.checkpoint()))
        check_interrupted(scene, part), check_files(scene.output.directory, part.name);
      else if ((part.is_coarse ? facts.continuum_coarse : facts.continuum).finished &&
               std::filesystem::exists(part.directory + "/continuum.h5"))
        check_results(part), check_files(scene.output.directory, part.name);
  }
} // namespace diptych::coupling
