// diptych: run SCENE --check, and the check before an ensemble: whether a scene can run
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/commands.h"

#include <algorithm>

#include "coupling/comparison/prepared_sample.h"
#include "coupling/grains/imported_grains.h"
#include "coupling/panels/continuum_loading.h"
#include "coupling/panels/continuum_mesh.h"
#include "coupling/processes/stop_signal.h"
#include "coupling/program/compare_command.h"
#include "coupling/program/resource_estimate.h"
#include "coupling/scene/scene_error.h"

namespace diptych::coupling
{
  namespace
  {
    // Every sample of an ensemble of imported ones must be there, each once.
    void check_imported_seeds(Scene &scene, const std::vector<int> &seeds)
    {
      if (scene.discrete.method.method != discrete::Method::imported)
        return;
      if (scene.discrete.method.file.find("{seed}") == std::string::npos)
        throw SceneError("--seeds: discrete/file = '" + scene.discrete.method.file +
                         "' is one sample; write {seed} in its path where the samples differ");
      for (const int seed : seeds)
        {
          scene.sample.seed = seed;
          (void)load_imported(scene);
        }
    }

    // Everything that would make all members of an ensemble fail is refused here.
    void check_seeds(Scene scene, const std::vector<int> &seeds)
    {
      if (!scene.sample.file.empty())
        throw SceneError("--seeds: sample/file = '" + scene.sample.file +
                         "' is one sample; only samples that are generated depend on a seed");
      check_imported_seeds(scene, seeds);
    }

    // Checks the first sample before the folder is opened; its errors are those of all samples.
    void check_first_sample(const CommandLine &line, Scene scene, const int seed)
    {
      scene.sample.seed = seed;
      const auto sample = prepared_grains(scene, line.quiet);
      leave_if_stopped("preparing the sample");
      if (!sample)
        return;
      require_elements_fit(scene, height_of(sample->outline));
      require_comparable_sample(scene.comparison.probes, *sample);
    }
  } // namespace

  int check_run(const CommandLine &line, const Scene &scene, const std::vector<int> &seeds)
  {
    if (!seeds.empty())
      check_seeds(scene, seeds);
    require_continuum(scene);
    check_comparable(scene);
    require_platen_travel(scene);
    announce_resources(line, scene, {true, true, std::max(1, int(seeds.size()))});
    if (line.checks_only)
      say(line, scene.name + ": fine; the run also checks the prepared sample");
    else if (!line.resume && scene.discrete.method.method != discrete::Method::imported)
      check_first_sample(line, scene, seeds.empty() ? scene.sample.seed : seeds.front());
    return done;
  }
} // namespace diptych::coupling
