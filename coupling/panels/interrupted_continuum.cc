// diptych: checks the files of an interrupted continuum run before --resume changes anything
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/panels/interrupted_continuum.h"

#include <filesystem>

#include "continuum/history.h"
#include "coupling/panels/continuum_mesh.h"
#include "coupling/grains/interrupted_grains.h"
#include "coupling/scene/identity.h"
#include "coupling/scene/scene_error.h"
#include "coupling/store/continuum_checkpoint_file.h"
#include "coupling/store/continuum_snapshot_file.h"
#include "coupling/store/file_names.h"
#include "coupling/store/provenance.h"
#include "discrete/files/table_file.h"

namespace diptych::coupling
{
  namespace
  {
    void check_results(const ContinuumPart &part)
    {
      (void)discrete::read_history<continuum::HistoryRow>(continuum_csv(part.directory));
      (void)read_continuum_snapshots(continuum_h5(part.directory));
    }

    void check_interrupted(const ContinuumPart &part, const std::string &scene, const continuum::Options &options)
    {
      const ContinuumCheckpoint checkpoint = read_continuum_checkpoint(part.checkpoint());
      if (checkpoint.scene != scene)
        throw SceneError("--resume: " + part.checkpoint() + " belongs to another scene");
      if (options.mesh.kind != continuum::MeshOption::Kind::outline &&
          checkpoint.sample != identity_of(mesh_of(options, part.edge, nullptr)))
        throw SceneError("--resume: " + part.checkpoint() + " belongs to another mesh");
      discrete::check_table(continuum_csv(part.directory), discrete::csv_header<continuum::HistoryRow>(), checkpoint.n_rows);
      const std::string snapshots = continuum_h5(part.directory);
      check_stage_count(snapshots, read_continuum_snapshots(snapshots).size(), std::size_t(checkpoint.panel.stage) + 1);
    }
  } // namespace

  void check_earlier_continuum(const Scene &scene)
  {
    const RunFacts facts = read_run_facts(scene.output.directory);
    for (const ContinuumPart &part : continuum_parts(scene))
      if (std::filesystem::exists(part.checkpoint()))
        {
          check_interrupted(part, text_of(continuum_identity(scene)), scene.continuum);
          check_files(scene.output.directory, part.name);
        }
      else if ((part.is_coarse ? facts.continuum_coarse : facts.continuum).finished &&
               std::filesystem::exists(continuum_h5(part.directory)))
        {
          check_results(part);
          check_files(scene.output.directory, part.name);
        }
  }
} // namespace diptych::coupling
