// diptych: run SCENE --check: whether a scene can run
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/commands.h"

#include <algorithm>

#include "coupling/comparison/prepared_sample.h"
#include "coupling/import/imported_folder.h"
#include "coupling/panels/continuum_loading.h"
#include "coupling/panels/continuum_mesh.h"
#include "coupling/processes/stop_signal.h"
#include "coupling/program/compare_command.h"
#include "coupling/program/resource_estimate.h"
#include "coupling/scene/scene_error.h"
#include "coupling/scene/seed_list.h"

namespace diptych::coupling
{
  namespace
  {
    // Every sample of an ensemble of imported ones must be there, each once.
    void check_imported_seeds(const CommandLine &line, Scene &scene)
    {
      if (scene.discrete.method.method != discrete::Method::imported)
        return;
      if (scene.discrete.method.file.find("{seed}") == std::string::npos)
        throw SceneError("--seeds " + line.seeds + ": discrete/file = '" + scene.discrete.method.file +
                         "' is one sample; write {seed} in its path where the samples differ");
      for (const int seed : read_seeds(line.seeds))
        {
          scene.sample.seed = seed;
          (void)load_imported(scene);
        }
    }

    // Everything that would make all members of an ensemble fail is refused here.
    void check_seeds(const CommandLine &line, Scene scene)
    {
      for (const std::string &text : line.overrides)
        if (text.rfind("sample/seed=", 0) == 0)
          throw SceneError("--set " + text + ": --seeds " + line.seeds + " sets the seed of each member");
      if (!scene.sample.file.empty())
        throw SceneError("--seeds " + line.seeds + ": sample/file = '" + scene.sample.file +
                         "' is one sample; only samples that are generated depend on a seed");
      check_imported_seeds(line, scene);
    }

    // What all samples have in common is found wrong with the first, before the folder is opened.
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

  int check_run(const CommandLine &line)
  {
    const std::vector<int> seeds = line.seeds.empty() ? std::vector<int>() : read_seeds(line.seeds);
    const Scene            scene = scene_of(line);
    if (!seeds.empty())
      check_seeds(line, scene);
    require_continuum(scene);
    check_comparable(scene);
    require_platen_travel(scene);
    announce_resources(line, scene, {true, true, std::max(1, int(seeds.size()))});
    if (!line.resume && scene.discrete.method.method != discrete::Method::imported)
      check_first_sample(line, scene, seeds.empty() ? scene.sample.seed : seeds.front());
    return done;
  }
} // namespace diptych::coupling
