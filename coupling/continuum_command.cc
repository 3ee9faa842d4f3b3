// diptych: the continuum alone: meshes, run, checkpoints, resume; on one process or several
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/continuum_command.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <optional>
#include <sstream>

#include <nlohmann/json.hpp>

#include "continuum/checkpoint.h"
#include "continuum/output.h"
#include "coupling/continuum_loading.h"
#include "coupling/continuum_mesh.h"
#include "coupling/initial_stress.h"
#include "coupling/processes.h"
#include "coupling/progress.h"
#include "coupling/provenance.h"
#include "coupling/result_folder.h"
#include "coupling/stop_signal.h"

namespace diptych::coupling
{
  namespace
  {
    using nlohmann::json;

    // What the runs take over from the grains. The snapshot is the first process's.
    struct Grains
    {
      double                            solid_fraction = 0;
      std::optional<discrete::Snapshot> snapshot;
    };

    // Its provenance says so, and no stage is missing: either alone may be left of another run.
    bool is_finished(const Scene &scene, const ContinuumPart &part)
    {
      const json        record = read_provenance(scene.output.directory).value(part.name, json::object());
      const std::string h5     = part.directory + "/continuum.h5";
      if (!record.value("finished", false) || std::filesystem::exists(part.checkpoint()) || !std::filesystem::exists(h5))
        return false;
      return continuum::read_stage_summaries(h5).size() == stages(scene.loading).size() + 1;
    }

    json facts_of(const continuum::Report &report)
    {
      const bool localised = report.localisation_strain.has_value();
      return {{"cells", report.n_cells},
              {"unknowns", report.n_unknowns},
              {"steps", report.steps},
              {"processes", n_processes()},
              {"localisation_strain", localised ? json(*report.localisation_strain) : json(nullptr)},
              {"localisation_angle_deg", localised ? json(report.localisation_angle) : json(nullptr)},
              {"finished", report.status == continuum::Status::finished},
              {"reached_axial_strain", report.axial_strain},
              {"message", report.message}};
    }

    // Nothing of an earlier run may be left to be taken for this one's.
    void clear(const Scene &scene, const ContinuumPart &part)
    {
      forget_fact(scene.output.directory, part.name);
      remove_results(part.directory, {"continuum.h5", "continuum.xdmf", "continuum.csv", "continuum.pvd", "continuum",
                                      "continuum_checkpoint.h5"});
    }

    // An interrupted part goes on where its files and checkpoint stand.
    std::optional<continuum::ResultFiles> open_files(const Scene               &scene,
                                                     const ContinuumPart       &part,
                                                     const std::vector<double> &stages,
                                                     const bool                 resume)
    {
      std::optional<continuum::ResultFiles> files;
      on_first_process([&] {
        if (resume)
          {
            files.emplace(part.directory, continuum::read_checkpoint(part.checkpoint()).scalars.at("progress"), stages);
            return 0;
          }
        clear(scene, part);
        files.emplace(part.directory);
        return 0;
      });
      return files;
    }

    continuum::Report run_part(const CommandLine   &line,
                               const Scene         &scene,
                               const ContinuumPart &part,
                               const Grains        &grains,
                               const bool           resume)
    {
      ContinuumSample sample           = measure_mesh(part.mesh());
      sample.solid_fraction            = grains.solid_fraction;
      const continuum::Loading loading = continuum_loading(scene, sample);
      auto                     files   = open_files(scene, part, loading.stages, resume);
      Progress                 progress(line.quiet);
      std::ostringstream       phase;
      phase << "continuum, elements of " << part.element_size << " d";

      continuum::Callbacks callbacks;
      callbacks.checkpoint_file = part.checkpoint();
      callbacks.resume          = resume;
      callbacks.stop_requested  = stop_requested;
      callbacks.on_stage        = [&](const continuum::Snapshot &snapshot) { files->add(snapshot); };
      callbacks.on_step         = [&](const continuum::HistoryRow &row) {
        files->add(row);
        progress.update(phase.str(), row.axial_strain / loading.stages.back());
      };
      callbacks.initial_stress = [&](const continuum::Snapshot &nodes) {
        return grain_stress_on_cells(*grains.snapshot, nodes, scene.loading.pressure);
      };
      const continuum::Report report = continuum::run(part.mesh(), scene.sample.mean_diameter, loading, scene.continuum,
                                                      callbacks);
      progress.finish();
      on_first_process([&] {
        files->finish();
        if (report.status == continuum::Status::finished)
          std::filesystem::remove(part.checkpoint());
        return 0;
      });
      return report;
    }

    // Meshes of all parts; those of an interrupted run stay, because its checkpoints belong to them.
    int make_ready(const CommandLine &line, const Scene &scene, const ContinuumTask &task, Grains &grains)
    {
      const bool with_grains = scene.continuum.mesh == "outline";
      if (with_grains)
        grains.snapshot = prepared_grains(line, scene, task.grains_from_file);
      if (with_grains && !grains.snapshot)
        return not_converged;
      grains.solid_fraction = with_grains ? solid_fraction(*grains.snapshot) : scene.sample.solid_fraction;
      if (!task.resume)
        remove_results(scene.output.directory, {"coarse"});
      for (const ContinuumPart &part : continuum_parts(scene))
        {
          if (!task.resume)
            clear(scene, part);
          std::filesystem::create_directories(part.directory);
          if (!task.resume || !std::filesystem::exists(part.checkpoint()) || !std::filesystem::exists(part.mesh()))
            write_mesh(scene, part, grains.snapshot ? &*grains.snapshot : nullptr);
        }
      return done;
    }

    // What the curve says, and what should not be overlooked in it.
    void say_result(const CommandLine &line, const std::string &law, const ContinuumPart &part, const continuum::Report &report)
    {
      const auto rows = continuum::read_history(part.directory + "/continuum.csv");
      if (rows.empty())
        return;
      const auto larger_by = [](const auto member) {
        return [member](const auto &a, const auto &b) { return a.*member < b.*member; };
      };
      const auto largest = [&](const auto member) { return *std::max_element(rows.begin(), rows.end(), larger_by(member)); };
      const auto peak    = largest(&continuum::HistoryRow::stress_ratio);
      std::ostringstream text;
      text << part.title << ": t/s " << peak.stress_ratio << " at most, at " << 100 * peak.axial_strain << " %, "
           << rows.back().stress_ratio << " at " << 100 * rows.back().axial_strain << " %; " << report.n_cells << " elements, "
           << report.n_unknowns << " unknowns, " << report.steps << " steps, " << report.cut_backs << " cut-backs";
      if (report.localisation_strain)
        text << "\n  ellipticity first lost, at one point, at " << 100 * *report.localisation_strain << " %, along a line at "
             << report.localisation_angle << " degrees";
      if (const double share = largest(&continuum::HistoryRow::viscous_share).viscous_share; share > 0)
        text << "\n  viscosity carries up to " << 100 * share << " % of the shear strength where the sample yields";
      double outside = 0; // at rest all three stresses are equal, and nothing depends on their order
      for (const continuum::HistoryRow &row : rows)
        outside = row.step > 0 ? std::max(outside, row.share_zz_not_intermediate) : outside;
      if (law == "cosserat_mohr_coulomb" && outside > 0)
        text << "\n  sigma_zz is not the intermediate principal stress in up to " << 100 * outside
             << " % of the area, where this law's in-plane form is not exact"
             << (outside > 0.05 ? ": hold the result against cosserat_drucker_prager" : "");
      say(line, text.str());
    }

    void say_how_it_ended(const CommandLine &line, const Scene &scene, const ContinuumPart &part, const continuum::Report &report)
    {
      if (report.status == continuum::Status::finished || !is_first_process())
        return;
      std::cerr << part.title << ": " << report.message << "; reached " << reached(scene.loading, report.axial_strain)
                << ", kept in " << part.directory;
      if (report.status == continuum::Status::stopped_by_user && std::filesystem::exists(part.checkpoint()))
        std::cerr << "; to go on: " << (n_processes() > 1 ? "mpirun -np " + std::to_string(n_processes()) + " " : "")
                  << "diptych " << line.command << ' ' << line.target << " --output " << scene.output.directory
                  << " --resume (with the same --set)";
      std::cerr << std::endl;
    }

    // The part from the beginning or from its checkpoint, with its cost and facts.
    continuum::Status run_and_record(const CommandLine   &line,
                                     const Scene         &scene,
                                     const ContinuumPart &part,
                                     const Grains        &grains,
                                     const bool           wants_resume)
    {
      const bool              resume = on_first_process([&] {
        if (wants_resume && !std::filesystem::exists(part.checkpoint()))
          say(line, part.title + ": no checkpoint in " + part.directory + ": from the beginning");
        return int(wants_resume && std::filesystem::exists(part.checkpoint()));
      });
      PhaseTimer              timer(part.name);
      const continuum::Report report = run_part(line, scene, part, grains, resume);
      PhaseCost               cost   = timer.stop();
      cost.cpu_s                     = sum_over_processes(cost.cpu_s);
      on_first_process([&] {
        update_provenance(scene.output.directory, scene, line.text, {cost}, {{part.name, facts_of(report)}});
        say_result(line, scene.continuum.law, part, report);
        return 0;
      });
      say_how_it_ended(line, scene, part, report);
      return report.status;
    }
  } // namespace

  bool may_resume_continuum(const Scene &scene)
  {
    const std::string &directory = scene.output.directory, earlier = earlier_echo(directory);
    if (continuum_part(earlier) == continuum_part(echo(scene)))
      return true;
    for (const std::string &folder : {directory, directory + "/coarse"})
      if (const std::string file = folder + "/continuum_checkpoint.h5"; std::filesystem::exists(file))
        throw SceneError(
          "--resume: " + file +
          " belongs to another scene: the section continuum or comparison/coarse_element_size differs; resume with "
          "the same scene or start without --resume");
    return false;
  }

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
    if (const int code = on_first_process([&] {
          remove_results(scene.output.directory, comparison_files);
          return make_ready(line, scene, task, grains);
        });
        code != done)
      return code;
    grains.solid_fraction = from_first_process(grains.solid_fraction);

    int code = done;
    for (const ContinuumPart &part : to_run)
      {
        const continuum::Status status = run_and_record(line, scene, part, grains, task.resume);
        if (status != continuum::Status::finished)
          code = not_converged;
        if (status == continuum::Status::stopped_by_user)
          break;
      }
    return code;
  }

  int run_continuum(const CommandLine &line)
  {
    const Scene scene = scene_of(line);
    require_continuum(scene);
    ContinuumTask task;
    task.resume = on_first_process([&] {
      const bool resume = line.resume && may_resume_continuum(scene);
      open_result_folder(scene, line.resume);
      return int(resume);
    });
    return continuum_panel(line, scene, task);
  }
} // namespace diptych::coupling
