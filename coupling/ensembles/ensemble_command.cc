// diptych: run SCENE --seeds: the same scene on many samples
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/ensembles/ensemble_command.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

#include <deal.II/base/mpi.h>

#include <nlohmann/json.hpp>

#include "coupling/ensembles/child_process.h"
#include "coupling/ensembles/ensemble_folder.h"
#include "coupling/ensembles/ensemble_members.h"
#include "coupling/ensembles/ensemble_output.h"
#include "coupling/processes.h"
#include "coupling/progress.h"
#include "coupling/provenance.h"
#include "coupling/result_folder.h"
#include "coupling/ensembles/seed_list.h"
#include "coupling/stop_signal.h"

namespace diptych::coupling
{
  namespace
  {
    using nlohmann::json;

    std::string joined(const std::vector<int> &seeds)
    {
      std::string text;
      for (const int seed : seeds)
        text += (text.empty() ? "" : ", ") + std::to_string(seed);
      return text;
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
      check_comparable(line, scene);
      // A single run of the scene may stand in its own folder.
      if (line.output.empty() && scene.output.directory == "results/" + scene.name)
        scene.output.directory += "_ensemble";
      return scene;
    }

    MemberRuns runs_of(const CommandLine &line, const Scene &scene)
    {
      MemberRuns runs;
      runs.command = {own_path(), "run", line.target, "--quiet", "--threads", std::to_string(line.threads)};
      for (const std::string &text : line.overrides)
        runs.command.insert(runs.command.end(), {"--set", text});
      if (line.resume)
        runs.command.emplace_back("--resume");
      runs.directory = scene.output.directory;
      // mpirun starts a process for every core that is to work.
      const int fitting = n_processes() > 1 ? 1 : std::max(1, n_usable_cores() / line.threads);
      runs.jobs         = line.jobs > 0 ? line.jobs : fitting;
      runs.quiet        = line.quiet;
      return runs;
    }

    std::string how_to_resume(const CommandLine &line, const Scene &scene)
    {
      return (n_processes() > 1 ? "mpirun -np " + std::to_string(n_processes()) + " " : "") + "diptych run " + line.target +
             " --seeds " + line.seeds + " --output " + scene.output.directory + " --resume (with the same --set)";
    }

    Member read_member(const Scene &scene, const int seed)
    {
      const std::string path = member_folder(scene.output.directory, seed) + "/comparison.json";
      try
        {
          std::ifstream file(path);
          Member        member = member_of(json::parse(file));
          if (is_mirror_symmetric(scene))
            fold(member);
          return member;
        }
      catch (const std::exception &error)
        {
          throw std::runtime_error(path + ": " + error.what());
        }
    }

    EnsembleRecord record_of(const Scene &scene, const std::vector<int> &seeds, const std::vector<MemberOutcome> &outcomes)
    {
      EnsembleRecord record;
      record.seeds              = seeds;
      std::vector<int> finished = seeds;
      const auto       drop     = [&finished](const int seed) {
        finished.erase(std::remove(finished.begin(), finished.end(), seed), finished.end());
      };
      for (const MemberOutcome &outcome : outcomes)
        if (outcome.interrupted)
          record.interrupted.push_back(outcome.seed), drop(outcome.seed);
        else if (outcome.exit_code != 0)
          {
            const std::string log = member_log(scene.output.directory, outcome.seed);
            record.failed.push_back({outcome.seed, outcome.exit_code, last_words(log)}), drop(outcome.seed);
          }
      std::vector<Member> members;
      for (const int seed : finished)
        members.push_back(read_member(scene, seed));
      record.ensemble = evaluate(members, scene.comparison.margins);
      return record;
    }

    void draw_report(const CommandLine &line, const Scene &scene)
    {
      Progress progress(line.quiet);
      progress.update("drawing the report of the ensemble", 0);
      run_script("ensemble.py", {scene.output.directory});
      progress.finish();
      say(line, "report: " + std::filesystem::absolute(scene.output.directory + "/report.html").lexically_normal().string());
    }

    // "window 0-0.01 band angle_deg: cannot tell: continuum - grains -1.1 [-3.8, 1.6] degrees, margin 3, 8 pairs"
    std::string text_of(const PanelVerdict &verdict)
    {
      const Equivalence &e     = verdict.equivalence;
      const double       scale = verdict.relative ? 100 : 1;
      const std::string  unit  = verdict.relative ? " % of the grains' mean" : verdict.unit == "-" ? "" : " " + verdict.unit;
      std::ostringstream out;
      out.precision(3);
      out << verdict.quantity << ": " << coupling::text_of(e.verdict);
      if (e.n > 0)
        out << ": continuum - grains " << scale * e.difference.value << " [" << scale * e.difference.low << ", "
            << scale * e.difference.high << ']' << unit << ", margin " << scale * verdict.margin;
      out << ", " << e.n << " pairs";
      return out.str();
    }

    void write_record(const CommandLine &line, const Scene &scene, const EnsembleRecord &record, const PhaseTimer &timer)
    {
      const std::string &directory = scene.output.directory;
      write_ensemble_json(directory, scene, record);
      write_ensemble_csv(directory, record.ensemble);
      update_provenance(directory, scene, line.text, {timer.stop()}, {{"seed", nullptr}, {"seeds", record.seeds}});
      for (const PanelVerdict &verdict : record.ensemble.verdicts)
        say(line, text_of(verdict));
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

    // Makes the folder ready; the seeds that are not finished yet.
    std::vector<int> prepared_seeds(const CommandLine &line, const Scene &scene, const std::vector<int> &seeds)
    {
      std::vector<int> pending = seeds;
      on_first_process([&] {
        if (line.resume && !is_ensemble_folder(scene.output.directory))
          say(line, "no ensemble in " + scene.output.directory + ": from the beginning");
        open_ensemble_folder(scene, seeds, line.resume);
        const auto is_finished = [&](const int seed) { return line.resume && is_finished_member(scene, seed); };
        pending.erase(std::remove_if(pending.begin(), pending.end(), is_finished), pending.end());
        if (pending.size() < seeds.size())
          say(line, std::to_string(seeds.size() - pending.size()) + " of " + std::to_string(seeds.size()) +
                      " seeds are finished in " + scene.output.directory + ": not run again");
        return 0;
      });
      return dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, pending);
    }

    Scene scene_of_ensemble(const CommandLine &line)
    {
      for (const std::string &text : line.overrides)
        if (text.rfind("comparison/margin_", 0) != 0 && text.rfind("output/", 0) != 0)
          throw SceneError("--set " + text +
                           ": only comparison/margin_* and output/ can be changed without running the members again");
      Scene scene            = read_scene(line.target + "/ensemble.prm", line.overrides);
      scene.output.directory = line.target;
      scene.name             = read_provenance(line.target).value("scene", scene.name);
      return scene;
    }
  } // namespace

  int run_ensemble(const CommandLine &line)
  {
    const std::vector<int> seeds = read_seeds(line.seeds);
    const Scene            scene = ensemble_scene(line);
    PhaseTimer             timer("ensemble");
    MemberRuns             runs = runs_of(line, scene);
    runs.seeds                  = prepared_seeds(line, scene, seeds);
    runs.n_finished_before      = int(seeds.size() - runs.seeds.size());
    const auto outcomes         = run_members(runs);
    return on_first_process([&] {
      const EnsembleRecord record = record_of(scene, seeds, outcomes);
      write_record(line, scene, record, timer);
      if (scene.output.report && record.interrupted.empty())
        draw_report(line, scene);
      return conclude(line, scene, record);
    });
  }

  int compare_ensemble_again(const CommandLine &line)
  {
    const Scene                scene = scene_of_ensemble(line);
    PhaseTimer                 timer("statistics");
    std::ifstream              file(line.target + "/ensemble.json");
    const json                 earlier = json::parse(file, nullptr, /* exceptions */ false);
    std::vector<MemberOutcome> outcomes;
    if (!earlier.is_object() || !earlier.contains("seeds"))
      throw std::runtime_error(line.target + "/ensemble.json is missing or broken");
    for (const json &failed : earlier.value("failed", json::array()))
      outcomes.push_back({failed.at("seed"), failed.at("exit_code")});
    for (const int seed : earlier.value("interrupted", std::vector<int>()))
      outcomes.push_back({seed, 0, true});
    const EnsembleRecord record = record_of(scene, earlier["seeds"], outcomes);
    write_record(line, scene, record, timer);
    if (scene.output.report)
      draw_report(line, scene);
    return done;
  }

  int report_ensemble_again(const CommandLine &line)
  {
    draw_report(line, scene_of_ensemble(line));
    return done;
  }
} // namespace diptych::coupling
