// diptych: runs the discrete panel and writes its files
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/grains/recorded_grains.h"

#include <cmath>
#include <filesystem>
#include <sstream>

#include "coupling/grains/interrupted_grains.h"
#include "coupling/processes/stop_signal.h"
#include "coupling/scene/identity.h"
#include "coupling/store/file_names.h"

namespace diptych::coupling
{
  namespace
  {
    std::string accuracy_text(const discrete::Snapshot &s, const double wanted)
    {
      if (std::isnan(s.stress_error))
        return "";
      std::ostringstream out;
      out.precision(2);
      out << "snapshot at " << text_of(s.loading_variable, s.progress) << ": residual " << s.residual
          << ", error of grain stress ";
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
  } // namespace

  discrete::Hooks shared_hooks(discrete::Processes &processes)
  {
    discrete::Hooks hooks;
    hooks.processes      = &processes;
    hooks.stop_requested = [&processes] { return processes.of_first(stop_requested()) != 0; };
    return hooks;
  }

  RecordedGrains::RecordedGrains(const RunOptions                                &options,
                                 const Scene                                     &scene,
                                 const std::optional<discrete::StoredCheckpoint> &checkpoint)
      : options(options),
        scene(scene),
        identity(text_of(sample_identity(scene))),
        progress(options.quiet),
        panel(scene.sample, discrete_loading(scene.loading), scene.discrete, hooks())
  {
    if (!checkpoint)
      return;
    announced = true;
    table.emplace(discrete_csv(scene.output.directory), discrete::csv_header<discrete::HistoryRow>(), checkpoint->n_rows);
    snapshots.emplace(path("discrete"), std::size_t(checkpoint->panel.stage) + 1);
    share(options.followers, Followers::resume_grains, [&] { panel.resume(checkpoint->panel); });
  }

  int RecordedGrains::n_stages() const
  {
    return int(stages(scene.loading).size());
  }

  const discrete::Report &RecordedGrains::run()
  {
    if (!table && !is_prepared)
      prepare();
    if (!table && panel.report().status == discrete::Status::finished)
      begin_files();
    share(options.followers, Followers::load_grains, [this] {
      for (int stage = panel.stage() + 1; panel.report().status == discrete::Status::finished && stage <= n_stages(); ++stage)
        {
          const bool reached = panel.advance_to(stage) == discrete::Status::finished;
          if (reached || panel.has_snapshot())
            add_snapshot();
        }
    });
    progress.finish(panel.report().status == discrete::Status::finished);
    if (table)
      table->flush();
    if (panel.report().status == discrete::Status::stopped_by_user && table)
      save();
    if (panel.report().status == discrete::Status::finished)
      {
        snapshots->close();
        std::filesystem::remove(grain_checkpoint(scene.output.directory));
      }
    return panel.report();
  }

  discrete::Hooks RecordedGrains::hooks()
  {
    discrete::Hooks hooks;
    if (options.followers)
      hooks = shared_hooks(options.followers->processes);
    else
      hooks.stop_requested = stop_requested;
    hooks.on_progress = [this](const std::string &phase, const double fraction) {
      progress.update(phase, fraction, reached_text(results.rows));
    };
    hooks.before_step = [this] { before_step(); };
    hooks.on_row      = [this](const discrete::HistoryRow &row) { add_row(row); };
    hooks.on_problem  = [this](const int stage, const discrete::ContactProblem &problem, const discrete::StoredGeometry &geometry,
                              const std::vector<discrete::Impulse> &impulses) {
      discrete::write_fclib(contact_problem(scene.output.directory, stage), problem,
                             {scene.name + ", stage " + std::to_string(stage), options.text}, geometry, impulses);
    };
    return hooks;
  }

  void RecordedGrains::prepare()
  {
    share(options.followers, Followers::prepare_grains, [this] { (void)panel.prepare(); }); // its report says how it ended
    is_prepared = true;
  }

  void RecordedGrains::begin_files()
  {
    table.emplace(discrete_csv(scene.output.directory), discrete::csv_header<discrete::HistoryRow>());
    snapshots.emplace(path("discrete"));
    add_snapshot();
  }

  // Prints the expected number of steps, all as long as the first, and their time at the pace of the preparation.
  void RecordedGrains::announce() const
  {
    const discrete::Report &report  = panel.report();
    const discrete::Loading loading = discrete_loading(scene.loading);
    const double            rate    = discrete::strain_rate(loading, scene.sample.mean_diameter, scene.sample.density);
    const double            steps   = std::ceil(loading.stages.back() / rate / report.step);
    std::ostringstream      text;
    text << "loading: about " << steps << " steps of length " << report.step << " for " << n_stages() << " stages";
    if (const int prepared = report.preparation.steps; prepared > 0)
      text << "; estimated time " << duration_text(steps * report.preparation_cpu_s / prepared);
    say(options, text.str());
  }

  void RecordedGrains::add_row(const discrete::HistoryRow &row)
  {
    table->add(discrete::csv_line(row));
    results.rows.push_back(row);
    if (Clock::now() - flushed < std::chrono::seconds(1))
      return;
    table->flush();
    flushed = Clock::now();
  }

  void RecordedGrains::add_snapshot()
  {
    discrete::Snapshot snapshot = panel.snapshot();
    table->flush();
    snapshots->add(snapshot);
    if (const std::string text = accuracy_text(snapshot, scene.discrete.sampling.snapshot_accuracy); !text.empty())
      warnings += text + "\n";
    if (keeps_snapshots)
      results.snapshots.push_back(std::move(snapshot));
  }

  void RecordedGrains::before_step()
  {
    if (!announced)
      announce();
    announced = true;
    if (std::chrono::duration<double>(Clock::now() - saved).count() >= 60 * scene.discrete.method.checkpoint_minutes)
      save();
  }

  // Rows first: the checkpoint records how many rows belong to it.
  void RecordedGrains::save()
  {
    table->flush();
    discrete::write_checkpoint(grain_checkpoint(scene.output.directory), {panel.checkpoint(), table->n_rows(), identity});
    saved = Clock::now();
  }
} // namespace diptych::coupling
