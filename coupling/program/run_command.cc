// diptych: run SCENE: both panels, homogenisation, comparison, report
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/commands.h"

#include <iostream>
#include <stdexcept>

#include "coupling/comparison/prepared_sample.h"
#include "coupling/panels/continuum_loading.h"
#include "coupling/panels/continuum_mesh.h"
#include "coupling/panels/interrupted_continuum.h"
#include "coupling/grains/interrupted_grains.h"
#include "coupling/program/compare_command.h"
#include "coupling/program/continuum_command.h"
#include "coupling/program/discrete_command.h"
#include "coupling/program/report_page.h"
#include "coupling/program/resource_estimate.h"
#include "coupling/scene/identity.h"
#include "coupling/store/provenance.h"
#include "coupling/store/result_folder.h"

namespace diptych::coupling
{
  namespace
  {
    // Once the grains have run, the folder has changed: wrong input then ends the run with exit code 3, and the results are kept.
    template <class Part> int after_the_grains(const Scene &scene, const Part &part)
    {
      try
        {
          return part();
        }
      catch (const std::invalid_argument &error)
        {
          std::cerr << "diptych: " << error.what() << "; " << kept_in(scene.output.directory) << std::endl;
          return not_converged;
        }
    }

    // Panels that ran in this process hand over what they computed; what was finished before is read.
    Results results_of(const Scene                    &scene,
                       const std::string              &of_continuum,
                       std::optional<DiscreteResults> &grains,
                       ContinuumRun                   &continuum)
    {
      if (!grains || !continuum.fine || continuum.coarse.has_value() != (continuum_parts(scene).size() > 1))
        return load_results(scene.output.directory, of_continuum);
      return {std::move(*grains), std::move(*continuum.fine), std::move(continuum.coarse).value_or(ContinuumResults()),
              read_run_facts(scene.output.directory).phases};
    }
  } // namespace

  int run_both(const CommandLine &line, const Scene &scene)
  {
    require_continuum(scene);
    check_comparable(scene);
    require_platen_travel(scene);
    if (is_held(line, scene, "run", &ResultFolder::holds_finished_run))
      {
        if (scene.output.report)
          say(line, "report: " + report_file(scene.output.directory));
        return done;
      }
    return writing(scene.output.directory, [&](FolderLock &lock) {
      std::unique_ptr<RecordedGrains> prepared;
      const SceneChanges              changes = ResultFolder(scene).open(lock, opening_of(line), [&](const SceneChanges &found) {
        announce_resources(line, scene, {true, true, 1, number_of_processes(line.followers)});
        if (line.resume)
          check_earlier_grains(scene.output.directory, text_of(sample_identity(scene)));
        if (line.resume && found.continuum.empty())
          check_earlier_continuum(scene);
        prepared = prepared_early(line, scene);
        if (!prepared || !prepared->is_ready())
          return;
        const discrete::Snapshot sample = prepared->sample();
        require_elements_fit(scene, height_of(sample.outline));
        require_comparable_sample(scene.comparison.probes, sample);
      });
      std::optional<DiscreteResults>  grains;
      if (const int code = discrete_panel(line, scene, std::move(prepared), &grains); code != done)
        return code;
      return after_the_grains(scene, [&] {
        const std::string &directory = scene.output.directory, folder = continuum_folder(line, scene, changes);
        ContinuumRun       continuum;
        ContinuumTask      task;
        task.results = &continuum;
        int code     = done;
        share(line.followers, folder == directory ? Followers::run_continuum : Followers::run_next_continuum,
              [&] { code = continuum_beside_grains(line, scene, folder, task); });
        if (code != done)
          return code;
        return compare_and_report(line, scene, results_of(scene, folder, grains, continuum),
                                  folder == directory ? next_comparison(directory) : folder);
      });
    });
  }
} // namespace diptych::coupling
