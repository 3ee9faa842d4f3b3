// diptych: the grains alone: run, checkpoints, resume, study of the step
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/discrete_command.h"

#include <chrono>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <optional>
#include <sstream>

#include <nlohmann/json.hpp>

#include "coupling/progress.h"
#include "coupling/provenance.h"
#include "coupling/result_folder.h"
#include "coupling/comparison/step_comparison.h"
#include "coupling/stop_signal.h"
#include "discrete/checkpoint.h"
#include "discrete/output.h"

namespace diptych::coupling
{
  namespace
  {
    using nlohmann::json;

    json number(const double value)
    {
      return std::isfinite(value) ? json(value) : json(nullptr);
    }

    // How often the kinetic energy rose above twice M |V|^2/4: dynamic crises of the slow deformation.
    int bursts(const std::vector<discrete::HistoryRow> &rows)
    {
      int count = 0;
      for (std::size_t k = 1; k < rows.size(); ++k)
        count += rows[k].kinetic_energy_ratio > 2 && rows[k - 1].kinetic_energy_ratio <= 2;
      return count;
    }

    json discrete_facts(const discrete::Report &report, const std::vector<discrete::HistoryRow> &rows)
    {
      return {{"preparation_solid_fraction", report.preparation.solid_fraction},
              {"preparation_friction", report.preparation.friction},
              {"preparation_steps", report.preparation.steps},
              {"preparation_residual", report.preparation.residual},
              {"preparation_unbalanced_force", report.preparation.unbalanced_force},
              {"initial_height", report.initial_height},
              {"platen_speed", report.platen_speed},
              {"step", report.step},
              {"step_bound", report.step_bound},
              {"halved_steps", report.halved_steps},
              {"kinetic_energy_bursts", bursts(rows)},
              {"ns_per_update", report.updates > 0 ? 1e9 * report.solver_cpu_s / double(report.updates) : 0},
              {"solver_share_of_cpu", report.loading_cpu_s > 0 ? report.solver_cpu_s / report.loading_cpu_s : 0},
              {"residual_factor", number(report.error_over_residual)},
              {"residual_factor_reference_residual", number(report.reference_residual)},
              {"residual_factor_error", number(report.reference_error)},
              {"residual_factor_estimate", number(report.estimated_error)},
              {"snapshots_sampled", report.snapshots_sampled},
              {"snapshots_accurate", report.snapshots_accurate},
              {"finished", report.status == discrete::Status::finished},
              {"reached_axial_strain", report.axial_strain},
              {"message", report.message}};
    }

    std::string problem_name(const int stage)
    {
      char name[32];
      std::snprintf(name, sizeof name, "/problem_%04d.h5", stage);
      return name;
    }

    // What an interrupted run left, or nothing where it left nothing of use.
    std::optional<discrete::Checkpoint> found_checkpoint(const Scene &scene)
    {
      const std::string path = scene.output.directory + "/checkpoint.h5";
      if (!std::filesystem::exists(path))
        return std::nullopt;
      discrete::Checkpoint checkpoint = discrete::read_checkpoint(path);
      if (checkpoint.scene != sample_part(echo(scene)))
        throw SceneError("--resume: " + path + " belongs to another scene: the sections sample, loading or discrete differ");
      return checkpoint;
    }

    bool is_finished(const Scene &scene)
    {
      const json record = read_provenance(scene.output.directory).value("discrete", json::object());
      return record.value("finished", false) && std::filesystem::exists(scene.output.directory + "/discrete.h5");
    }

    // Tells of every sampled snapshot how accurate its grain stress is.
    std::string accuracy_text(const discrete::Snapshot &s, const double wanted)
    {
      if (std::isnan(s.stress_error))
        return "";
      std::ostringstream out;
      out.precision(2);
      out << "snapshot at " << 100 * s.axial_strain << " %: residual " << s.residual << ", error of grain stress ";
      if (std::isfinite(s.stress_error))
        out << 100 * s.stress_error << " % (estimated)";
      else
        out << "not known (it still changed by " << 100 * s.stress_change << " % in the last doubling of the sweeps)";
      if (!std::isnan(s.error_over_residual))
        out << ", error/residual " << s.error_over_residual;
      if (!(s.stress_error <= wanted))
        out << "; snapshot_accuracy " << 100 * wanted << " % not reached in snapshot_max_sweeps";
      return out.str();
    }

    // What makes a finished run doubtful goes to standard error, quiet or not.
    void warn(const std::vector<discrete::HistoryRow> &rows)
    {
      constexpr double doubtful_penetration = 0.02, doubtful_gain = 0.1;
      double           penetration = 0;
      for (const discrete::HistoryRow &row : rows)
        penetration = std::max(penetration, row.max_penetration);
      if (penetration > doubtful_penetration)
        std::cerr << "discrete panel: warning: grains interpenetrate by up to " << penetration
                  << " mean diameters; a shorter step or a smaller tolerance is needed" << std::endl;
      if (!rows.empty() && rows.back().impact_dissipation < -doubtful_gain * std::abs(rows.back().external_work))
        std::cerr << "discrete panel: warning: contacts gave " << -rows.back().impact_dissipation
                  << " of energy against an external work of " << rows.back().external_work << "; the step is too long"
                  << std::endl;
    }

    // What came of the copy that was solved on to measure error against residual.
    std::string reference_text(const discrete::Report &report)
    {
      if (std::isnan(report.reference_residual))
        return "";
      std::ostringstream out;
      out.precision(2);
      out << "first snapshot solved on for reference_sweeps: residual " << report.reference_residual
          << ", grain stress differs by " << 100 * report.reference_error << " %; ";
      if (std::isnan(report.error_over_residual))
        out << "too far from a solution to measure error over residual against";
      else
        out << "error over residual " << report.error_over_residual;
      return out.str() + "\n";
    }

    // What the panel's callbacks fill and write.
    struct Recording
    {
      using Clock = std::chrono::steady_clock;

      const CommandLine                &line;
      const Scene                      &scene;
      std::vector<discrete::Snapshot>   snapshots = {};
      std::vector<discrete::HistoryRow> rows      = {};
      std::string                       warnings  = {};
      Clock::time_point                 saved     = Clock::now();

      std::string path(const std::string &name) const { return scene.output.directory + "/" + name; }

      void take_up(const discrete::Checkpoint &checkpoint)
      {
        snapshots = discrete::read_snapshots(path("discrete.h5"));
        snapshots.resize(std::min<std::size_t>(snapshots.size(), checkpoint.progress.stage + 1));
        rows = checkpoint.rows;
      }

      void add(const discrete::Snapshot &snapshot)
      {
        snapshots.push_back(snapshot);
        discrete::write_snapshots(path("discrete"), snapshots);
        discrete::write_history(path("discrete.csv"), rows);
        const std::string text = accuracy_text(snapshot, scene.discrete.sampling.snapshot_accuracy);
        if (!text.empty())
          warnings += text + "\n";
      }

      bool checkpoint_due() const
      {
        return std::chrono::duration<double>(Clock::now() - saved).count() >= 60 * scene.discrete.method.checkpoint_minutes;
      }

      void save(const discrete::Progress &progress)
      {
        discrete::write_checkpoint(path("checkpoint.h5"), {progress, rows, sample_part(echo(scene))});
        saved = Clock::now();
      }
    };

    int say_how_it_ended(const CommandLine &line, const Scene &scene, const discrete::Report &report)
    {
      if (report.status == discrete::Status::finished)
        return done;
      std::cerr << "discrete panel: "
                << (report.status == discrete::Status::stopped_by_user ? "stopped on request" : report.message) << "; reached "
                << reached(report.axial_strain) << ", kept in " << scene.output.directory;
      if (report.status == discrete::Status::stopped_by_user &&
          std::filesystem::exists(scene.output.directory + "/checkpoint.h5"))
        std::cerr << "; to go on: diptych " << line.command << ' ' << line.target << " --output " << scene.output.directory
                  << " --resume (with the same --set)";
      std::cerr << std::endl;
      return not_converged;
    }
  } // namespace

  int discrete_panel(const CommandLine &line, const Scene &scene)
  {
    const std::string                        &directory  = scene.output.directory;
    const std::optional<discrete::Checkpoint> checkpoint = line.resume ? found_checkpoint(scene) : std::nullopt;
    Recording                                 recording{line, scene};
    if (line.resume && !checkpoint && is_finished(scene))
      {
        say(line, "the grains are finished in " + directory + ": not run again");
        return done;
      }
    if (line.resume && !checkpoint)
      say(line, "no checkpoint in " + directory + ": from the beginning");
    remove_results(directory, comparison_files);
    if (checkpoint)
      recording.take_up(*checkpoint);
    else
      {
        forget_fact(directory, "discrete"); // of an earlier run: killed, this one is not finished
        remove_results(directory, {"discrete.h5", "discrete.xdmf", "discrete.csv", "checkpoint.h5"});
        for (std::size_t stage = 1; stage <= stages(scene.loading).size(); ++stage)
          std::filesystem::remove(directory + problem_name(int(stage)));
      }

    Progress            progress(line.quiet);
    discrete::Callbacks callbacks;
    callbacks.stop_requested = stop_requested;
    callbacks.on_progress    = [&](const std::string &phase, const double fraction) { progress.update(phase, fraction); };
    callbacks.on_step        = [&](const discrete::HistoryRow &row) { recording.rows.push_back(row); };
    callbacks.on_stage       = [&](const discrete::Snapshot &snapshot) { recording.add(snapshot); };
    callbacks.on_problem = [&](const int stage, const discrete::ContactProblem &problem, const discrete::StoredGeometry &geometry,
                               const std::vector<discrete::Impulse> &impulses) {
      discrete::write_fclib(directory + problem_name(stage), problem,
                            {scene.name + ", stage " + std::to_string(stage), line.text}, geometry, impulses);
    };
    callbacks.checkpoint_due = [&] { return recording.checkpoint_due(); };
    callbacks.on_checkpoint  = [&](const discrete::Progress &now) { recording.save(now); };
    PhaseTimer             timer("discrete");
    const discrete::Report report = discrete::run(scene.sample, discrete_loading(scene.loading), scene.discrete, callbacks,
                                                  checkpoint ? &checkpoint->progress : nullptr);
    progress.finish();
    discrete::write_history(directory + "/discrete.csv", recording.rows);
    if (report.status == discrete::Status::finished)
      remove_results(directory, {"checkpoint.h5"});
    PhaseCost loading = timer.stop(), preparation = loading;
    preparation.name  = "preparation";
    preparation.cpu_s = preparation.wall_s = report.preparation_cpu_s;
    if (!checkpoint)
      loading.cpu_s -= report.preparation_cpu_s, loading.wall_s -= report.preparation_cpu_s;
    update_provenance(directory, scene, line.text, {preparation, loading},
                      {{"discrete", discrete_facts(report, recording.rows)}});
    recording.warnings += reference_text(report);
    warn(recording.rows);
    if (!recording.warnings.empty() && report.snapshots_accurate < report.snapshots_sampled)
      std::cerr << recording.warnings << std::flush;
    else if (!recording.warnings.empty())
      say(line, recording.warnings.substr(0, recording.warnings.size() - 1));
    return say_how_it_ended(line, scene, report);
  }

  void check_study(const CommandLine &line, const Scene &scene)
  {
    if (line.study != "step")
      throw SceneError("--study " + line.study + ": only step is known");
    if (scene.discrete.method.method == "penalty")
      throw SceneError(
        "--study step: discrete/method = penalty takes its step from penalty_step_fraction, not from discrete/step");
    if (!scene.discrete.time.step)
      throw SceneError("--study step: discrete/step must be a number to be halved, not auto");
  }

  int step_study(const CommandLine &line, const Scene &scene)
  {
    std::vector<StepRun> runs;
    for (const int divisor : {1, 2, 4})
      {
        Scene part            = scene;
        part.output.directory = scene.output.directory + "/step_" + std::to_string(divisor);
        *part.discrete.time.step /= divisor;
        open_result_folder(part, line.resume);
        if (const int code = discrete_panel(line, part); code != done)
          return code;
        runs.push_back({*part.discrete.time.step, read_history(part.output.directory + "/discrete.csv")});
      }
    const StepComparison comparison = compare_steps(runs, scene.comparison.averaging_strain);
    write_step_comparison(scene.output.directory, runs, comparison);
    run_script("step_study.py", {scene.output.directory});
    say(line, comparison.verdict);
    say(line, "study of the step: " + scene.output.directory + "/study_step.png");
    return done;
  }
} // namespace diptych::coupling
