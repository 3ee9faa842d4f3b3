// diptych: the continuum alone: meshes, run, checkpoints, resume; on one process or several
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/continuum_command.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <optional>
#include <sstream>

#include "coupling/panels/continuum_loading.h"
#include "coupling/panels/interrupted_continuum.h"
#include "coupling/panels/recorded_continuum.h"
#include "coupling/panels/processes.h"
#include "coupling/program/commands.h"
#include "coupling/program/resource_estimate.h"
#include "coupling/scene/identity.h"
#include "coupling/scene/scene_file.h"
#include "coupling/statistics/history_table.h"
#include "coupling/store/file_names.h"
#include "coupling/store/provenance.h"
#include "coupling/store/result_folder.h"
#include "discrete/panel/snapshot_file.h"

namespace diptych::coupling
{
  namespace
  {
    // Input of the runs from the grains. Only the first process has the snapshot.
    struct Grains
    {
      double                            solid_fraction = 0;
      std::optional<discrete::Snapshot> snapshot;

      const discrete::Snapshot *pointer() const { return snapshot ? &*snapshot : nullptr; }
    };

    const continuum::Report &facts_of_part(const RunFacts &facts, const ContinuumPart &part)
    {
      return part.is_coarse ? facts.continuum_coarse : facts.continuum;
    }

    // Its provenance says so, and no stage is missing: either alone may be left of another run.
    bool is_finished(const Scene &scene, const ContinuumPart &part)
    {
      return facts_of_part(read_run_facts(scene.output.directory), part).finished &&
             !std::filesystem::exists(part.checkpoint()) &&
             count_continuum_snapshots(continuum_h5(part.directory)) == stages(scene.loading).size() + 1;
    }

    int take_grains(const CommandLine &line, const Scene &scene, const ContinuumTask &task, Grains &grains)
    {
      const bool with_grains = scene.continuum.mesh.kind == continuum::MeshOption::Kind::outline;
      if (with_grains && !task.grains_file.empty())
        grains.snapshot = discrete::read_snapshots(task.grains_file).front();
      else if (with_grains && task.prepared)
        grains.snapshot = task.prepared;
      else if (with_grains)
        {
          const PhaseTimer timer("preparation");
          grains.snapshot = prepared_grains(scene, line.quiet);
          record_phases(scene.output.directory, {scene.name, {scene.sample.seed}, line.text}, {timer.stop()});
        }
      if (with_grains && !grains.snapshot)
        {
          std::cerr << kept_in(scene.output.directory) << std::endl;
          return not_converged;
        }
      grains.solid_fraction = with_grains ? solid_fraction(*grains.snapshot) : scene.sample.solid_fraction;
      return done;
    }

    // Prints the peak and the warnings of a run.
    void say_result(const CommandLine                        &line,
                    const Scene                              &scene,
                    const ContinuumPart                      &part,
                    const continuum::Report                  &report,
                    const std::vector<continuum::HistoryRow> &rows)
    {
      if (rows.empty())
        return;
      const auto larger_by = [](const auto member) {
        return [member](const auto &a, const auto &b) { return a.*member < b.*member; };
      };
      const auto largest = [&](const auto member) { return *std::max_element(rows.begin(), rows.end(), larger_by(member)); };
      const auto peak    = peak_of_running_mean(history_table(rows), "stress_ratio", averaging_width(scene));
      const auto at      = [](const continuum::HistoryRow &row) { return text_of(row.loading_variable, row.progress); };
      std::ostringstream text;
      text.precision(4);
      text << part.title << ": ";
      if (std::isfinite(peak.value)) // a shorter loading has no running mean
        text << "peak t/s " << peak.value << " at " << text_of(rows.back().loading_variable, peak.progress) << ", ";
      text << "t/s at the end " << rows.back().stress_ratio << " at " << at(rows.back()) << "; " << report.n_cells
           << " elements, " << report.n_unknowns << " unknowns, " << report.steps << " steps, " << report.cut_backs
           << " cut-backs";
      if (const double share = largest(&continuum::HistoryRow::viscous_share).viscous_share; share > 0)
        text << "\n  viscosity carries up to " << 100 * share << " % of the shear strength where the sample yields";
      if (const double share = largest(&continuum::HistoryRow::unstable_share).unstable_share; share > 0)
        text << "\n  up to " << 100 * share << " % of the area weakens in a step while its plastic flow contracts (at "
             << at(largest(&continuum::HistoryRow::unstable_share)) << "): a material instability, which the mesh may decide. "
             << "continuum/internal_length (Cosserat and gradient laws) or continuum/viscosity limits it";
      if (part.is_coarse)
        text << "\n  this second run shows the effect of the mesh; comparison/coarse_element_size = 0 leaves it out";
      say(line, text.str());
    }

    void say_how_it_ended(const CommandLine &line, const Scene &scene, const ContinuumPart &part, const continuum::Report &report)
    {
      if (report.status == continuum::Status::finished || !is_first_process())
        return;
      std::cerr << part.title << ": " << report.message << "; reached "
                << text_of(discrete::loading_variable_of(scene.loading.mode), report.progress) << ", kept in " << part.directory;
      if (report.status == continuum::Status::stopped_by_user && std::filesystem::exists(part.checkpoint()))
        std::cerr << "; to go on: " << (n_processes() > 1 ? "mpirun -np " + std::to_string(n_processes()) + " " : "")
                  << "diptych " << name_of(line.command) << ' ' << line.target << " --output " << scene.output.directory
                  << " --resume (with the same --set)";
      std::cerr << std::endl;
    }

    // The part from the beginning or from its checkpoint, with its cost and facts. Its results go where the task wants them.
    continuum::Status run_and_record(const CommandLine   &line,
                                     const Scene         &scene,
                                     const ContinuumPart &part,
                                     const Grains        &grains,
                                     const ContinuumTask &task)
    {
      const bool        resume = on_first_process([&] {
        const bool found = task.resume && std::filesystem::exists(part.checkpoint());
        if (line.resume && !found)
          say(line, part.title + ": no checkpoint in " + part.directory + ": from the beginning");
        if (found)
          forget_files(scene.output.directory, part.name);
        else
          forget_fact(scene.output.directory, part.name);
        return int(found);
      });
      const PhaseTimer  timer(part.name);
      RecordedContinuum recorded(line, scene, part, grains.pointer(), grains.solid_fraction, resume);
      recorded.keeps_snapshots = task.results != nullptr;
      continuum::Report report = recorded.run();
      report.finished          = report.status == continuum::Status::finished;
      PhaseCost cost           = timer.stop();
      cost.cpu_s               = sum_over_processes(cost.cpu_s);
      on_first_process([&] {
        record_phases(scene.output.directory, {scene.name, {scene.sample.seed}, line.text},
                      {resume ? with_earlier_sessions(scene.output.directory, cost) : cost});
        record_facts(scene.output.directory, part.name, report);
        say_result(line, scene, part, report,
                   resume ? discrete::read_rows<continuum::HistoryRow>(continuum_csv(part.directory)) : recorded.results.rows);
        if (task.results != nullptr && !resume)
          {
            recorded.results.facts                                       = report;
            (part.is_coarse ? task.results->coarse : task.results->fine) = std::move(recorded.results);
          }
        return 0;
      });
      say_how_it_ended(line, scene, part, report);
      return report.status;
    }
  } // namespace

  int continuum_panel(const CommandLine &line, const Scene &scene, const ContinuumTask &task)
  {
    // Asked of all parts before the first runs: what was finished before is not run again.
    std::vector<ContinuumPart> to_run;
    for (const ContinuumPart &part : continuum_parts(scene))
      if (on_first_process([&] { return int(task.resume && is_finished(scene, part)); }) == 0)
        to_run.push_back(part);
      else
        say(line, part.title + " is finished in " + part.directory + ": not run again");
    if (to_run.empty())
      return done;

    Grains grains;
    if (const int code = on_first_process([&] { return take_grains(line, scene, task, grains); }); code != done)
      return code;
    grains.solid_fraction = from_first_process(grains.solid_fraction);

    int code = done;
    for (const ContinuumPart &part : to_run)
      {
        const continuum::Status status = run_and_record(line, scene, part, grains, task);
        if (status != continuum::Status::finished)
          code = not_converged;
        if (status == continuum::Status::stopped_by_user)
          break;
      }
    return code;
  }

  std::string continuum_folder(const CommandLine &line, const Scene &scene, const SceneChanges &changes)
  {
    const std::string &directory = scene.output.directory;
    if (changes.continuum.empty() || !std::filesystem::exists(continuum_h5(directory)))
      return directory;
    say(line, "the continuum in " + directory + " belongs to other keys (" + changes.continuum +
                "): it is computed again; the new one then replaces it");
    return next_continuum(directory);
  }

  int continuum_beside_grains(const CommandLine &line, const Scene &scene, const std::string &folder, ContinuumTask task)
  {
    const std::string &directory = scene.output.directory;
    if (task.grains_file.empty() && std::filesystem::exists(discrete_h5(directory)))
      task.grains_file = discrete_h5(directory);
    Scene next            = scene;
    next.output.directory = folder;
    if (folder != directory)
      task.resume = on_first_process([&] { return int(ResultFolder(scene).open_next_continuum(line.text)); });
    return continuum_panel(line, next, task);
  }

  int run_continuum(const CommandLine &line, const Scene &scene)
  {
    require_continuum(scene);
    announce_resources(line, scene, {false, true});
    std::optional<FolderLock> lock;
    return keeping(scene.output.directory, [&] {
      const std::string &directory = scene.output.directory;
      ContinuumTask      task;
      std::string        folder;
      const bool         replaces = on_first_process([&] {
        lock.emplace(directory);
        const SceneChanges changes = ResultFolder(scene).open(*lock, opening_of(line, true), [&](const SceneChanges &found) {
          if (found.continuum.empty())
            check_earlier_continuum(scene);
          else if (scene.sample.target_solid_fraction > 0 && scene.continuum.mesh.kind == continuum::MeshOption::Kind::outline)
            task.prepared = prepared_grains(scene, line.quiet); // shows whether the solid fraction can be reached
        });
        folder                     = continuum_folder(line, scene, changes);
        return int(folder != directory);
      });
      const int          code     = continuum_beside_grains(line, scene, replaces ? next_continuum(directory) : directory, task);
      if (code == done && replaces)
        on_first_process([&] {
          const bool had_comparison = std::filesystem::exists(comparison_json(directory));
          complete_record(directory, folder);
          take(directory, folder);
          say(line, "the new continuum has replaced the earlier one in " + directory +
                      (had_comparison ? "; the comparison with the earlier one was removed" : ""));
          return 0;
        });
      return code;
    });
  }
} // namespace diptych::coupling
