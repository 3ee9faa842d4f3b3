// diptych: run SCENE --seeds: the same scene on many samples
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/ensemble_command.h"

#include <algorithm>
#include <iostream>
#include <optional>

#include "coupling/comparison/prepared_sample.h"
#include "coupling/ensembles/ensemble_curves.h"
#include "coupling/ensembles/ensemble_folder.h"
#include "coupling/ensembles/seed_list.h"
#include "coupling/import/imported_folder.h"
#include "coupling/panels/continuum_loading.h"
#include "coupling/panels/continuum_mesh.h"
#include "coupling/processes/processes.h"
#include "coupling/processes/stop_signal.h"
#include "coupling/program/compare_command.h"
#include "coupling/program/ensemble_record.h"
#include "coupling/program/report_command.h"
#include "coupling/program/resource_estimate.h"
#include "coupling/program/worker_command.h"
#include "coupling/scene/identity.h"
#include "coupling/scene/scene_error.h"
#include "coupling/store/result_folder.h"

namespace diptych::coupling
{
  namespace
  {
    std::string joined(const std::vector<int> &seeds)
    {
      std::string text;
      for (const int seed : seeds)
        text += (text.empty() ? "" : ", ") + std::to_string(seed);
      return text;
    }

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

    // Everything that would make all members fail is refused here.
    Scene ensemble_scene(const CommandLine &line)
    {
      for (const std::string &text : line.overrides)
        if (text.rfind("sample/seed=", 0) == 0)
          throw SceneError("--set " + text + ": --seeds " + line.seeds + " sets the seed of each member");
      Scene scene = scene_of(line);
      if (!scene.sample.file.empty())
        throw SceneError("--seeds " + line.seeds + ": sample/file = '" + scene.sample.file +
                         "' is one sample; only samples that are generated depend on a seed");
      check_imported_seeds(line, scene);
      require_continuum(scene);
      check_comparable(scene);
      require_platen_travel(scene);
      // A single run of the scene may stand in its own folder.
      if (line.output.empty() && scene.output.directory == "results/" + scene.name)
        scene.output.directory += "_ensemble";
      return scene;
    }

    // Each seed is a run of its own in DIR/seed_K, its output in DIR/seed_K.log.
    Task member_task(const CommandLine &line, const Scene &scene, const int seed)
    {
      const std::string &directory = scene.output.directory;
      Task               task{"seed " + std::to_string(seed), {"run", line.target, "--quiet"}, member_log(directory, seed)};
      const auto         add = [&task](const std::string &option, const std::string &value) {
        task.words.insert(task.words.end(), {option, value});
      };
      add("--threads", std::to_string(line.threads));
      for (const std::string &text : line.overrides)
        add("--set", text);
      add("--set", "sample/seed=" + std::to_string(seed));
      add("--output", member_folder(directory, seed));
      if (line.resume)
        task.words.emplace_back("--resume");
      return task;
    }

    TaskQueue queue_of(const CommandLine &line, const Scene &scene, const std::vector<int> &seeds)
    {
      TaskQueue queue = workers_for(line, "seeds");
      for (const int seed : seeds)
        queue.tasks.push_back(member_task(line, scene, seed));
      return queue;
    }

    std::vector<MemberOutcome> outcomes_of(const std::vector<TaskOutcome> &tasks, const std::vector<int> &seeds)
    {
      std::vector<MemberOutcome> outcomes;
      for (const TaskOutcome &task : tasks)
        outcomes.push_back({seeds[task.task], task.exit_code, task.interrupted});
      return outcomes;
    }

    std::string how_to_resume(const CommandLine &line, const Scene &scene)
    {
      return (n_processes() > 1 ? "mpirun -np " + std::to_string(n_processes()) + " " : "") + "diptych run " + line.target +
             " --seeds " + line.seeds + " --output " + scene.output.directory + " --resume (with the same --set)";
    }

    int conclude(const CommandLine &line, const Scene &scene, const EnsembleRecord &record)
    {
      const std::string done_text = std::to_string(record.ensemble.seeds.size()) + " of " + std::to_string(record.seeds.size()) +
                                    " seeds are done";
      std::vector<int> failed;
      for (const FailedMember &member : record.failed)
        failed.push_back(member.seed);
      if (!failed.empty())
        std::cerr << "failed: seed " << joined(failed) << "; " << done_text << ", kept in " << scene.output.directory
                  << std::endl;
      if (!record.interrupted.empty())
        std::cerr << "stopped on request; " << done_text << ", kept in " << scene.output.directory
                  << "; to go on: " << how_to_resume(line, scene) << std::endl;
      return failed.empty() && record.interrupted.empty() ? done : not_converged;
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

    // Those that need not run again, by what stands in their folders. Throws, before anything changes, where that is damaged.
    std::vector<int> finished_seeds(const Scene &scene, const std::vector<int> &seeds)
    {
      std::vector<int> finished;
      for (const int seed : seeds)
        if (is_finished_member(scene, seed))
          finished.push_back(seed);
      (void)record_of(scene, finished, {});
      check_member_histories(scene.output.directory, finished);
      return finished;
    }

    // Makes the folder ready; the seeds that are not finished yet.
    std::vector<int> prepared_seeds(const CommandLine         &line,
                                    const Scene               &scene,
                                    const std::vector<int>    &seeds,
                                    std::optional<FolderLock> &lock)
    {
      std::vector<int> pending = seeds;
      on_first_process([&] {
        require_usable(scene.output.directory, opening_of(line));
        if (line.resume && !is_ensemble_folder(scene.output.directory))
          say(line, "no ensemble in " + scene.output.directory + ": from the beginning");
        if (!line.resume && scene.discrete.method.method != discrete::Method::imported)
          check_first_sample(line, scene, seeds.front());
        const std::vector<int> finished = line.resume ? finished_seeds(scene, seeds) : std::vector<int>();
        const auto is_finished          = [&](const int seed) { return std::count(finished.begin(), finished.end(), seed) > 0; };
        open_ensemble_folder(scene, *lock, seeds, opening_of(line));
        pending.erase(std::remove_if(pending.begin(), pending.end(), is_finished), pending.end());
        if (pending.size() < seeds.size())
          say(line, std::to_string(seeds.size() - pending.size()) + " of " + std::to_string(seeds.size()) +
                      " seeds are finished in " + scene.output.directory + ": not run again");
        return 0;
      });
      const std::vector<double> shared = from_first_process(std::vector<double>(pending.begin(), pending.end()));
      return {shared.begin(), shared.end()};
    }
  } // namespace

  int run_ensemble(const CommandLine &line)
  {
    const std::vector<int> seeds = read_seeds(line.seeds);
    const Scene            scene = ensemble_scene(line);
    announce_resources(line, scene, {true, true, int(seeds.size())});
    std::optional<FolderLock> lock;
    on_first_process([&] {
      lock.emplace(scene.output.directory);
      return 0;
    });
    const PhaseTimer       timer("ensemble");
    const std::vector<int> pending = prepared_seeds(line, scene, seeds, lock);
    TaskQueue              queue   = queue_of(line, scene, pending);
    queue.n_finished_before        = int(seeds.size() - pending.size());
    const auto outcomes            = outcomes_of(run_tasks(queue), pending);
    return on_first_process([&] {
      const EnsembleRecord record = record_of(scene, seeds, outcomes);
      write_record(line, scene, record, timer);
      if (scene.output.report && record.interrupted.empty())
        draw_page(line, Drawing::ensemble, scene.output.directory);
      return conclude(line, scene, record);
    });
  }
} // namespace diptych::coupling
