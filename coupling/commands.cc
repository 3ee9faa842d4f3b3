// diptych: what the program can be asked to do
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/commands.h"

#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>

#include <sys/wait.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "continuum/mesh.h"
#include "continuum/output.h"
#include "coupling/comparison.h"
#include "coupling/comparison_output.h"
#include "coupling/progress.h"
#include "coupling/provenance.h"
#include "discrete/text_file.h"
#include "coupling/stop_signal.h"
#include "coupling/version.h"
#include "discrete/outline.h"
#include "discrete/output.h"

namespace diptych::coupling
{
  namespace
  {
    using nlohmann::json;

    Scene scene_of(const CommandLine &line)
    {
      Scene scene = read_scene(line.target, line.overrides);
      if (!line.output.empty())
        scene.output.directory = line.output;
      return scene;
    }

    // What was derived from other results of the folder must not outlive them.
    void remove_results(const std::string &directory, const std::vector<std::string> &names)
    {
      for (const std::string &name : names)
        std::filesystem::remove_all(directory + "/" + name);
    }

    const std::vector<std::string> comparison_files = {"comparison.json", "comparison.csv", "comparison.h5", "fields.vtu",
                                                       "report.html"};

    const std::vector<std::string> panel_files = {"discrete.h5",    "discrete.xdmf",  "discrete.csv",  "continuum.h5",
                                                  "continuum.xdmf", "continuum.csv",  "continuum.pvd", "continuum",
                                                  "coarse",         "provenance.json"};

    // The sections sample, loading and discrete of an echoed scene: what decides which sample both panels show.
    std::string sample_part(const std::string &echoed)
    {
      const std::size_t begin = echoed.find("subsection sample"), end = echoed.find("subsection continuum");
      return begin == std::string::npos || end == std::string::npos ? "" : echoed.substr(begin, end - begin);
    }

    // The folder is made and the echo written only once the whole scene has been found good.
    void open_result_folder(const Scene &scene)
    {
      const std::string &directory = scene.output.directory;
      std::error_code    error;
      std::filesystem::create_directories(directory, error);
      if (error || access(directory.c_str(), W_OK) != 0)
        throw SceneError("output/directory = '" + directory + "' cannot be made or written to");
      std::ifstream      file(directory + "/scene.prm");
      std::ostringstream earlier;
      earlier << file.rdbuf();
      // A run replaces files and folders by name: only where an earlier one of its own stands may it do so.
      const bool is_result_folder = earlier.str().find(echo_title) != std::string::npos;
      if (!is_result_folder && !std::filesystem::is_empty(directory))
        throw SceneError("output/directory = '" + directory +
                         "' holds other files and no result of diptych; name a new or an empty folder");
      // Results of another sample must not be compared with what this run will make.
      if (is_result_folder && sample_part(earlier.str()) != sample_part(echo(scene)))
        remove_results(directory, panel_files);
      discrete::write_text(directory + "/scene.prm", echo(scene));
    }

    void say(const CommandLine &line, const std::string &text)
    {
      if (!line.quiet)
        std::cout << text << std::endl;
    }

    std::string reached(const double strain)
    {
      std::ostringstream out;
      out.precision(4);
      out << 100 * strain << " % axial strain";
      return out.str();
    }

    json discrete_facts(const discrete::Report &report)
    {
      return {{"preparation_solid_fraction", report.preparation.solid_fraction},
              {"preparation_steps", report.preparation.steps},
              {"preparation_residual", report.preparation.residual},
              {"preparation_unbalanced_force", report.preparation.unbalanced_force},
              {"initial_height", report.initial_height},
              {"platen_speed", report.platen_speed},
              {"ns_per_update", report.updates > 0 ? 1e9 * report.solver_cpu_s / double(report.updates) : 0},
              {"solver_share_of_cpu", report.loading_cpu_s > 0 ? report.solver_cpu_s / report.loading_cpu_s : 0},
              {"reached_axial_strain", report.axial_strain},
              {"message", report.message}};
    }

    int discrete_panel(const CommandLine &line, const Scene &scene)
    {
      const std::string &directory = scene.output.directory;
      remove_results(directory, {"discrete.h5", "discrete.xdmf", "discrete.csv"});
      remove_results(directory, comparison_files);

      std::vector<discrete::Snapshot>   snapshots;
      std::vector<discrete::HistoryRow> rows;
      Progress                          progress(line.quiet);
      discrete::Callbacks               callbacks;
      callbacks.stop_requested = stop_requested;
      callbacks.on_progress    = [&](const std::string &phase, const double fraction) { progress.update(phase, fraction); };
      callbacks.on_step        = [&](const discrete::HistoryRow &row) { rows.push_back(row); };
      callbacks.on_stage       = [&](const discrete::Snapshot &snapshot) {
        snapshots.push_back(snapshot);
        discrete::write_snapshots(directory + "/discrete", snapshots);
        discrete::write_history(directory + "/discrete.csv", rows);
      };
      PhaseTimer             timer("discrete");
      const discrete::Report report = discrete::run(scene.sample, discrete_loading(scene.loading), scene.discrete, callbacks);
      progress.finish();
      discrete::write_history(directory + "/discrete.csv", rows);
      PhaseCost loading = timer.stop(), preparation = loading;
      preparation.name  = "preparation";
      preparation.cpu_s = preparation.wall_s = report.preparation_cpu_s;
      loading.cpu_s -= report.preparation_cpu_s, loading.wall_s -= report.preparation_cpu_s;
      update_provenance(directory, scene, line.text, {preparation, loading}, {{"discrete", discrete_facts(report)}});

      if (report.status == discrete::Status::finished)
        return done;
      std::cerr << "discrete panel: "
                << (report.status == discrete::Status::stopped_by_user ? "stopped on request" : report.message) << "; reached "
                << reached(report.axial_strain) << ", kept in " << directory << std::endl;
      return not_converged;
    }

    // The outline that both meshes fill: of the prepared sample, kept as stage 0 of discrete.h5 or prepared again. Nothing
    // where the sample does not get quiet or the preparation is interrupted.
    std::optional<discrete::Outline> prepared_outline(const CommandLine &line, const Scene &scene, const bool from_file)
    {
      if (from_file)
        return discrete::read_snapshots(scene.output.directory + "/discrete.h5").front().outline;
      Progress   progress(line.quiet);
      const auto sample = discrete::prepare_sample(scene.sample, scene.discrete.lateral, scene.discrete.solver,
                                                   scene.loading.pressure, [&](const int step, const int expected) {
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

    // Runs the report script as a child of its own, no shell between.
    int draw_report(const CommandLine &line, const std::string &directory)
    {
      Progress progress(line.quiet);
      progress.update("drawing the report", 0);
      const pid_t child = fork();
      if (child == 0)
        {
          execl(python, python, report_script, directory.c_str(), static_cast<char *>(nullptr));
          _exit(127);
        }
      int status = 0;
      if (child < 0 || waitpid(child, &status, 0) < 0 || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
        throw std::runtime_error(std::string("the report could not be drawn: ") + python + " " + report_script + " " + directory);
      progress.finish();
      return done;
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
    open_result_folder(scene);
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
    open_result_folder(scene);
    return discrete_panel(line, scene);
  }

  int run_continuum(const CommandLine &line)
  {
    const Scene scene = scene_of(line);
    open_result_folder(scene);
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
