// diptych: run SCENE: both panels, homogenisation, comparison, report
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/run_command.h"

#include <iostream>
#include <stdexcept>

#include "coupling/comparison/prepared_sample.h"
#include "coupling/folders/result_folder.h"
#include "coupling/panels/continuum_loading.h"
#include "coupling/program/compare_command.h"
#include "coupling/program/continuum_command.h"
#include "coupling/program/discrete_command.h"
#include "coupling/program/interrupted_continuum.h"
#include "coupling/program/interrupted_grains.h"
#include "coupling/program/resource_estimate.h"

namespace diptych::coupling
{
  namespace
  {
    // Once the grains have run the folder is not as it was: what is wrong then ends the run with what it keeps.
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
  } // namespace

  int run_both(const CommandLine &line)
  {
    const Scene scene = scene_of(line);
    require_continuum(scene);
    check_comparable(scene);
    require_platen_travel(scene);
    announce_resources(line, scene, {true, true});
    return writing(scene.output.directory, [&] {
      const bool                      resume_continuum = line.resume && may_resume_continuum(scene);
      std::unique_ptr<RecordedGrains> prepared;
      open_result_folder(scene, line.resume, [&] {
        if (line.resume)
          check_earlier_grains(scene);
        if (resume_continuum)
          check_earlier_continuum(scene);
        prepared = prepared_early(line, scene);
        if (!prepared || !prepared->is_ready())
          return;
        const discrete::Snapshot sample = prepared->sample();
        require_elements_fit(scene, height_of(sample.outline));
        require_comparable_sample(scene, sample);
      });
      if (const int code = discrete_panel(line, scene, std::move(prepared)); code != done)
        return code;
      return after_the_grains(scene, [&] {
        const int code = continuum_panel(line, scene, {true, resume_continuum, {}});
        return code == done ? compare_and_report(line, scene) : code;
      });
    });
  }
} // namespace diptych::coupling
