// diptych: what the program can be asked to do
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/commands.h"

#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>

#include <nlohmann/json.hpp>

#include "continuum/mesh.h"
#include "continuum/output.h"
#include "coupling/comparison.h"
#include "coupling/comparison_output.h"
#include "coupling/discrete_command.h"
#include "coupling/progress.h"
#include "coupling/provenance.h"
#include "coupling/result_folder.h"
#include "coupling/stop_signal.h"
#include "discrete/outline.h"
#include "discrete/output.h"

namespace diptych::coupling
{
  namespace
  {
    using nlohmann::json;

    // The outline that both meshes fill: of the prepared sample, kept as stage 0 of discrete.h5 or prepared again. Nothing
    // where the sample does not get quiet or the preparation is interrupted.
    std::optional<discrete::Outline> prepared_outline(const CommandLine &line, const Scene &scene, const bool from_file)
    {
      if (from_file)
        return discrete::read_snapshots(scene.output.directory + "/discrete.h5").front().outline;
      Progress   progress(line.quiet);
      const auto sample = discrete::prepare_sample(scene.sample,
                                                   discrete::preparation_setting(discrete_loading(scene.loading), scene.discrete),
                                                   [&](const int step, const int expected) {
                                                     progress.update("preparing the sample", double(step) / expected);
                                                     return !stop_requested();
                                                   });
      progress.finish();
      if (sample.report.quiet)
        return discrete::make_outline(sample.state, scene.sample.mean_diameter);
      std::cerr << "preparing the sample: " << (stop_requested() ? "stopped on request" : "it did not get quiet") << " after "
                << sample.report.steps << " steps (residual " << sample.report.residual << ", unbalanced force "
                << sample.report.unbalanced_force << ")" << std::endl;
      return std::nullopt;
    }

    continuum::Report continuum_run(const CommandLine        &line,
                                    const Scene              &scene,
                                    const continuum::Outline &outline,
                                    const double              element_size,
                                    const std::string        &directory)
    {
      std::filesystem::create_directories(directory);
      remove_results(directory, {"continuum.h5", "continuum.xdmf", "continuum.csv", "continuum.pvd", "continuum"});
      const double      height = outline.left.back().y() - outline.left.front().y();
      const std::string mesh   = directory + "/sample.msh";
      continuum::make_mesh(outline, element_size * scene.sample.mean_diameter, mesh);

      continuum::ResultFiles files(directory);
      Progress               progress(line.quiet);
      std::ostringstream     phase;
      phase << "continuum, elements of " << element_size << " d";
      continuum::Callbacks callbacks;
      callbacks.stop_requested = stop_requested;
      callbacks.on_stage       = [&](const continuum::Snapshot &snapshot) { files.add(snapshot); };
      callbacks.on_step        = [&](const continuum::HistoryRow &row) {
        files.add(row);
        progress.update(phase.str(), row.axial_strain / scene.loading.axial_strain);
      };
      const continuum::Report report = continuum::run(mesh, continuum_loading(scene.loading, height), scene.continuum, callbacks);
      progress.finish();
      files.finish();
      return report;
    }

    int continuum_panel(const CommandLine &line, const Scene &scene, const bool outline_from_file)
    {
      const std::string &directory = scene.output.directory;
      remove_results(directory, comparison_files);
      const std::optional<discrete::Outline> grains = prepared_outline(line, scene, outline_from_file);
      if (!grains)
        return not_converged;
      const continuum::Outline outline{grains->left, grains->right};
      PhaseTimer               timer("continuum");
      const continuum::Report  report = continuum_run(line, scene, outline, scene.continuum.element_size, directory);
      const PhaseCost          fine   = timer.stop();
      PhaseTimer               coarse_timer("continuum_coarse");
      const continuum::Report  coarse = continuum_run(line, scene, outline, scene.comparison.coarse_element_size,
                                                      directory + "/coarse");
      update_provenance(directory, scene, line.text, {fine, coarse_timer.stop()},
                        {{"continuum",
                          {{"cells", report.n_cells},
                           {"unknowns", report.n_unknowns},
                           {"steps", report.steps},
                           {"reached_axial_strain", report.axial_strain},
                           {"message", report.message}}}});
      for (const auto &[name, r] : {std::pair{"continuum panel", &report}, std::pair{"continuum panel, coarse mesh", &coarse}})
        if (r->status != continuum::Status::finished)
          {
            std::cerr << name << ": " << r->message << "; reached " << reached(r->axial_strain) << ", kept in " << directory
                      << std::endl;
            return not_converged;
          }
      return done;
    }

    void draw_report(const CommandLine &line, const std::string &directory)
    {
      Progress progress(line.quiet);
      progress.update("drawing the report", 0);
      run_script("report.py", {directory});
      progress.finish();
    }

    int comparison_of(const CommandLine &line, const Scene &scene)
    {
      const std::string &directory = scene.output.directory;
      Progress           progress(line.quiet);
      progress.update("comparing", 0);
      PhaseTimer       timer("comparison");
      const Comparison c = compare(scene, directory);
      write_comparison_csv(directory, c);
      write_comparison_h5(directory, scene, c);
      write_fields_vtu(directory, c);
      update_provenance(directory, scene, line.text, {timer.stop()}, json::object());
      write_comparison_json(directory, scene, c, read_provenance(directory));
      progress.finish();
      for (const StageRecord &stage : c.stages)
        if (!(stage.total_relative_error < 1e-12))
          {
            std::cerr << "the mapping at " << reached(stage.axial_strain) << " misses the grains' total by "
                      << stage.total_relative_error << std::endl;
            return invariant;
          }
      return done;
    }

    int report_and_say(const CommandLine &line, const Scene &scene)
    {
      if (scene.output.report)
        {
          PhaseTimer timer("report");
          draw_report(line, scene.output.directory);
          update_provenance(scene.output.directory, scene, line.text, {timer.stop()}, json::object());
          say(line, "report: " + std::filesystem::absolute(scene.output.directory + "/report.html").lexically_normal().string());
        }
      return done;
    }

    // The scene that a result folder was made with, with overrides for what the comparison may change.
    Scene scene_of_folder(const CommandLine &line)
    {
      if (!std::filesystem::is_directory(line.target))
        throw SceneError(line.target + ": no result folder");
      for (const std::string &text : line.overrides)
        if (text.rfind("comparison/", 0) != 0 && text.rfind("output/", 0) != 0)
          throw SceneError("--set " + text + ": only comparison/ and output/ can be changed without running the panels again");
      Scene scene            = read_scene(line.target + "/scene.prm", line.overrides);
      scene.output.directory = line.target;
      const json record      = read_provenance(line.target);
      scene.name             = record.value("scene", scene.name);
      return scene;
    }
  } // namespace

  int run_both(const CommandLine &line)
  {
    const Scene scene = scene_of(line);
    require_continuum(scene);
    if (!line.study.empty())
      throw SceneError("--study " + line.study + ": only `diptych discrete` has studies");
    open_result_folder(scene, line.resume);
    if (const int code = discrete_panel(line, scene); code != done)
      return code;
    if (const int code = continuum_panel(line, scene, true); code != done)
      return code;
    if (const int code = comparison_of(line, scene); code != done)
      return code;
    return report_and_say(line, scene);
  }

  int run_discrete(const CommandLine &line)
  {
    const Scene scene = scene_of(line);
    if (!line.study.empty())
      check_study(line, scene);
    open_result_folder(scene, line.resume);
    return line.study.empty() ? discrete_panel(line, scene) : step_study(line, scene);
  }

  int run_continuum(const CommandLine &line)
  {
    const Scene scene = scene_of(line);
    require_continuum(scene);
    open_result_folder(scene, false);
    return continuum_panel(line, scene, false);
  }

  int compare_again(const CommandLine &line)
  {
    const Scene scene = scene_of_folder(line);
    if (const int code = comparison_of(line, scene); code != done)
      return code;
    return report_and_say(line, scene);
  }

  int report_again(const CommandLine &line)
  {
    const Scene scene = scene_of_folder(line);
    draw_report(line, scene.output.directory);
    say(line, "report: " + std::filesystem::absolute(scene.output.directory + "/report.html").lexically_normal().string());
    return done;
  }

  int explain_keys(const CommandLine &line)
  {
    std::cout << explain(line.target);
    return done;
  }
} // namespace diptych::coupling
