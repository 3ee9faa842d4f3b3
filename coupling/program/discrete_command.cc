// diptych: the grains alone: run, checkpoints, resume
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/discrete_command.h"

#include <cmath>
#include <filesystem>
#include <iostream>
#include <optional>
#include <sstream>

#include "coupling/comparison/checks.h"
#include "coupling/grains/imported_grains.h"
#include "coupling/grains/interrupted_grains.h"
#include "coupling/grains/recorded_grains.h"
#include "coupling/processes/progress.h"
#include "coupling/processes/stop_signal.h"
#include "coupling/program/commands.h"
#include "coupling/program/resource_estimate.h"
#include "coupling/scene/identity.h"
#include "coupling/statistics/history_table.h"
#include "coupling/scene/scene_error.h"
#include "coupling/store/file_names.h"
#include "coupling/store/provenance.h"
#include "coupling/store/result_folder.h"
#include "discrete/files/table_file.h"
#include "discrete/files/text_file.h"
#include "discrete/panel/checkpoint.h"
#include "discrete/panel/snapshot_file.h"

namespace diptych::coupling
{
  namespace
  {
    using Rows = std::vector<discrete::HistoryRow>;

    // How often the kinetic energy rose above twice M |V|^2/4: dynamic crises of the slow deformation.
    int bursts(const Rows &rows)
    {
      int count = 0;
      for (std::size_t k = 1; k < rows.size(); ++k)
        count += rows[k].kinetic_energy_ratio > 2 && rows[k - 1].kinetic_energy_ratio <= 2;
      return count;
    }

    // Grains of a file may be anywhere: where the pressure finds none to carry it, t/s is that of a few that fly.
    void doubt_idle_grains(const Rows &rows, const Scene &scene, std::ostream &out)
    {
      constexpr double idle = 0.1;
      if (rows.empty() || scene.loading.mode == discrete::LoadingMode::time || !(scene.loading.pressure > 0))
        return;
      double carried = 0; // s, mean over the rows
      for (const discrete::HistoryRow &row : rows)
        carried += 0.5 * row.stress.trace() / double(rows.size());
      if (!(carried >= idle * scene.loading.pressure))
        out << "the grains carry a mean stress of " << carried << ", less than " << idle
            << " of loading/pressure: nothing is pressed together, and t/s is that of single impacts\n";
    }

    void doubt_sample(const discrete::Report &report, const discrete::Options &options, std::ostream &out)
    {
      constexpr double doubtful_overlap = 1e-3, doubtful_force = 2;
      if (report.preparation.largest_overlap > doubtful_overlap)
        out << "the sample's grains overlap by up to " << report.preparation.largest_overlap
            << " mean diameters before they are loaded; sample/prepare_file = true takes that out\n";
      const double explosion = report.preparation.largest_overlap * options.penalty.stiffness; // of springs, overlap x kn / P
      if (options.method.method == discrete::Method::penalty && explosion > doubtful_force)
        out << "before they are pressed, the grains overlap by up to " << report.preparation.largest_overlap
            << " mean diameters: springs of penalty_stiffness " << options.penalty.stiffness << " push there with " << explosion
            << " d P\n";
    }

    // Explicit springs gain energy if their steps are long. A sample at rest has next to no external work, but round-off.
    void doubt_energy(const Rows &rows, const Scene &scene, std::ostream &out)
    {
      constexpr double doubtful_gain = 0.1, strain_at_rest = 1e-5;
      if (rows.empty() || scene.discrete.method.method != discrete::Method::penalty)
        return;
      const discrete::HistoryRow &last = rows.back();
      const double                gain = -last.impact_dissipation, rest = strain_at_rest * scene.loading.pressure;
      if (gain > std::max(doubtful_gain * std::abs(last.external_work), rest * last.width * last.width))
        out << "contacts gave " << gain << " of energy against an external work of " << last.external_work
            << "; a smaller discrete/penalty_step_fraction is needed\n";
    }

    // The reasons to doubt a finished run, a line each.
    std::string doubts(const Rows &rows, const discrete::Report &report, const Scene &scene)
    {
      const discrete::Options &options = scene.discrete;
      std::ostringstream       out;
      doubt_idle_grains(rows, scene, out);
      doubt_sample(report, options, out);
      if (report.expected.strength > most_strength_error(options.accuracy))
        out << "steps of " << report.step << " change the strength by about " << 100 * report.expected.strength
            << " %; discrete/step = auto keeps to discrete/accuracy\n";
      if (report.expected.dilation_loss > most_dilation_error(options.accuracy))
        out << "a tolerance of " << report.tolerance << " at this step loses about " << 100 * report.expected.dilation_loss
            << " % of the dilation; discrete/tolerance = auto keeps to " << discrete::dilation_share << " discrete/accuracy\n";
      double penetration = 0;
      for (const discrete::HistoryRow &row : rows)
        penetration = std::max(penetration, row.max_penetration);
      if (penetration > most_penetration)
        out << "grains interpenetrate by up to " << penetration << " mean diameters; "
            << (options.method.method == discrete::Method::nscd ? "a smaller discrete/step or discrete/tolerance"
                                                                : "a larger discrete/penalty_stiffness")
            << " is needed\n";
      doubt_energy(rows, scene, out);
      return out.str();
    }

    void say_result(const CommandLine &line, const Scene &scene, const Rows &rows)
    {
      if (rows.empty())
        return;
      const HistoryTable history = history_table(rows);
      const double       width = averaging_width(scene), end = rows.back().progress;
      const Peak         peak = peak_of_running_mean(history, "stress_ratio", width);
      const auto         at   = [&](const double progress) { return text_of(rows.back().loading_variable, progress); };
      std::ostringstream text;
      text.precision(4);
      text << "discrete panel: ";
      if (std::isfinite(peak.value)) // a shorter loading has no running mean
        text << "peak t/s " << peak.value << " at " << at(peak.progress) << ", ";
      text << "t/s at the end " << mean_over_progress(history, "stress_ratio", end - width, end) << " at " << at(end) << "; "
           << rows.back().step << " steps";
      if (const double number = inertial_number(scene);
          scene.loading.mode != discrete::LoadingMode::time && std::isfinite(number))
        text << ", I = " << number;
      say(line, text.str());
    }

    // To standard error, quiet or not.
    void tell_doubts(const std::string &doubts)
    {
      std::istringstream lines(doubts);
      for (std::string line; std::getline(lines, line);)
        std::cerr << "discrete panel: warning: " << line << std::endl;
    }

    // Result of the more accurate solve that gives error over residual.
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

    void record(const CommandLine      &line,
                const Scene            &scene,
                const discrete::Report &report,
                PhaseCost               loading,
                const bool              prepared_before)
    {
      PhaseCost preparation = loading;
      preparation.name      = "preparation";
      preparation.cpu_s     = report.preparation_cpu_s;
      preparation.wall_s    = report.preparation_wall_s;
      if (!prepared_before)
        {
          loading.cpu_s -= preparation.cpu_s;
          loading.wall_s -= preparation.wall_s;
        }
      record_phases(scene.output.directory, {scene.name, {scene.sample.seed}, line.text}, {preparation, loading});
      record_facts(scene.output.directory, report);
    }

    int say_how_it_ended(const CommandLine &line, const Scene &scene, const discrete::Report &report)
    {
      if (report.status == discrete::Status::finished)
        return done;
      std::cerr << "discrete panel: "
                << (report.status == discrete::Status::stopped_by_user ? "stopped on request" : report.message) << "; reached "
                << text_of(discrete::loading_variable_of(scene.loading.mode), report.progress) << ", kept in "
                << scene.output.directory;
      if (report.status == discrete::Status::stopped_by_user && std::filesystem::exists(grain_checkpoint(scene.output.directory)))
        std::cerr << "; to go on: diptych " << name_of(line.command) << ' ' << line.target << " --output "
                  << scene.output.directory << " --resume (with the same --set)";
      std::cerr << std::endl;
      return not_converged;
    }
  } // namespace

  bool is_held(const CommandLine &line, const Scene &scene, const std::string &part, bool (ResultFolder::*holds)() const)
  {
    if (line.resume || line.overwrite || !(ResultFolder(scene).*holds)())
      return false;
    say(line, scene.output.directory + " holds the finished " + part + " of this scene; --overwrite starts again");
    return true;
  }

  std::unique_ptr<RecordedGrains> prepared_early(const CommandLine &line, const Scene &scene)
  {
    const bool is_there = line.resume && (std::filesystem::exists(grain_checkpoint(scene.output.directory)) ||
                                          grains_are_finished(scene.output.directory));
    if (is_there || scene.discrete.method.method == discrete::Method::imported)
      return {};
    auto prepared = std::make_unique<RecordedGrains>(line, scene, std::nullopt);
    prepared->prepare();
    leave_if_stopped("preparing the sample");
    return prepared;
  }

  int discrete_panel(const CommandLine              &line,
                     const Scene                    &scene,
                     std::unique_ptr<RecordedGrains> prepared,
                     std::optional<DiscreteResults> *results)
  {
    if (scene.discrete.method.method == discrete::Method::imported)
      {
        take_imported(line, scene);
        return done;
      }
    const std::string &directory  = scene.output.directory;
    const auto         checkpoint = line.resume ? interrupted_grains(scene.output.directory, text_of(sample_identity(scene)))
                                                : std::nullopt;
    if (line.resume && !checkpoint && grains_are_finished(scene.output.directory))
      {
        say(line, "the grains are finished in " + directory + ": not run again");
        return done;
      }
    if (line.resume && !checkpoint)
      say(line, "no checkpoint in " + directory + ": from the beginning");
    if (checkpoint)
      forget_files(directory, "discrete");
    else
      forget_fact(directory, "discrete");

    const PhaseTimer timer("discrete");
    const bool       before      = checkpoint.has_value() || prepared != nullptr; // the timer began
    RecordedGrains  &recorded    = prepared ? *prepared : *(prepared = std::make_unique<RecordedGrains>(line, scene, checkpoint));
    recorded.keeps_snapshots     = results != nullptr;
    discrete::Report  report     = recorded.run();
    const std::string csv        = discrete_csv(directory);
    const Rows        rows       = !checkpoint                    ? recorded.results.rows
                                   : std::filesystem::exists(csv) ? discrete::read_rows<discrete::HistoryRow>(csv)
                                                                  : Rows();
    report.finished              = report.status == discrete::Status::finished;
    report.kinetic_energy_bursts = bursts(rows);
    report.warnings              = doubts(rows, report, scene);
    PhaseCost loading            = timer.stop();
    for (double *cpu_s : {&loading.cpu_s, &report.preparation_cpu_s})
      *cpu_s *= number_of_processes(line.followers); // all take the same time
    record(line, scene, report, checkpoint ? with_earlier_sessions(directory, loading) : loading, before);
    say_result(line, scene, rows);
    recorded.warnings += reference_text(report);
    tell_doubts(report.warnings);
    if (!recorded.warnings.empty() && report.snapshots_accurate < report.snapshots_sampled)
      std::cerr << recorded.warnings << std::flush;
    else if (!recorded.warnings.empty())
      say(line, recorded.warnings.substr(0, recorded.warnings.size() - 1));
    if (results != nullptr && !checkpoint)
      {
        recorded.results.facts = report;
        *results               = std::move(recorded.results);
      }
    return say_how_it_ended(line, scene, report);
  }

  void FollowedGrains::follow(const Followers::Task task)
  {
    if (task == Followers::prepare_grains || task == Followers::resume_grains)
      panel.emplace(scene.sample, discrete_loading(scene.loading), scene.discrete, shared_hooks(processes));
    if (task == Followers::prepare_grains)
      (void)panel->prepare();
    if (task == Followers::resume_grains)
      panel->resume(interrupted_grains(scene.output.directory, text_of(sample_identity(scene))).value().panel);
    if (task != Followers::load_grains)
      return;
    const int n_stages = int(stages(scene.loading).size());
    for (int stage = panel->stage() + 1; panel->report().status == discrete::Status::finished && stage <= n_stages; ++stage)
      (void)panel->advance_to(stage);
  }

  int run_discrete(const CommandLine &line, const Scene &scene)
  {
    if (scene.discrete.method.method == discrete::Method::imported)
      (void)load_imported(scene);
    if (is_held(line, scene, "grains", &ResultFolder::holds_finished_grains))
      return done;
    announce_resources(line, scene, {true, false, 1, number_of_processes(line.followers)});
    return writing(scene.output.directory, [&](FolderLock &lock) {
      std::unique_ptr<RecordedGrains> prepared;
      ResultFolder(scene).open(lock, opening_of(line), [&](const SceneChanges &) {
        if (line.resume)
          check_earlier_grains(scene.output.directory, text_of(sample_identity(scene)));
        prepared = prepared_early(line, scene);
      });
      return discrete_panel(line, scene, std::move(prepared));
    });
  }
} // namespace diptych::coupling
