// diptych: homogenisation and comparison of what a folder holds
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/compare_command.h"

#include <algorithm>
#include <filesystem>
#include <iostream>

#include "coupling/comparison/comparison_output.h"
#include "coupling/comparison/key_numbers.h"
#include "coupling/processes/progress.h"
#include "coupling/processes/stop_signal.h"
#include "coupling/program/commands.h"
#include "coupling/program/report_page.h"
#include "coupling/scene/scene_file.h"
#include "coupling/store/file_names.h"
#include "coupling/store/provenance.h"
#include "coupling/store/result_folder.h"
#include "discrete/files/text_file.h"

namespace diptych::coupling
{
  namespace
  {
    // An error here comes from the files of the folder.
    Comparison compared(const Scene &scene, const Results &results, Progress &progress)
    {
      const auto on_progress = [&](const double share) {
        leave_if_stopped("comparing");
        progress.update("comparing", share);
      };
      try
        {
          return compare(scene, results, on_progress);
        }
      catch (const std::invalid_argument &error)
        {
          throw std::invalid_argument(scene.output.directory + ": " + error.what());
        }
    }

    RunOrigin origin_of(const CommandLine &line, const Scene &scene)
    {
      return {scene.name, {scene.sample.seed}, line.text};
    }

    // Writes the comparison to the folder `next`.
    // `text`: the numbers that a user asks for first.
    int comparison_of(const CommandLine &line,
                      const Scene       &scene,
                      const Results     &results,
                      const std::string &next,
                      std::string       &text)
    {
      Progress progress(line.quiet);
      progress.update("comparing", 0);
      const PhaseTimer timer("comparison");
      Comparison       c = compared(scene, results, progress);
      if (next == next_comparison(scene.output.directory))
        ResultFolder(scene).open_next_comparison(line.text);
      complete_record(scene.output.directory, next);
      write_comparison_h5(next, {scene, c}, results);
      write_fields(next, c);
      record_phases(next, origin_of(line, scene), {timer.stop()});
      c.cost = summary_of(read_run_facts(next).phases);
      write_comparison(next, {scene, c});
      record_files(next, "comparison");
      text = text_of(key_numbers(c)) + sxx_text_of(c, scene.loading.pressure) +
             platens_text_of(c.discrete.platens, scene.continuum) + "\n" +
             text_of(checks_of(scene.discrete, scene.comparison, c)) + "\n" + origin_of_law(scene.comparison.parameters_from);
      progress.finish();
      for (const StageRecord &stage : c.stages)
        if (!(stage.mapping.total_relative_error < largest_error_of_the_total))
          {
            std::cerr << "the mapping at " << text_of(discrete::loading_variable_of(scene.loading.mode), stage.progress)
                      << " misses the grains' total by " << stage.mapping.total_relative_error << std::endl;
            return invariant;
          }
      return done;
    }

    // The scene that a result folder was made with, with overrides for what the comparison may change.
    Scene scene_of_folder(const CommandLine &line)
    {
      if (is_study_folder(line.target))
        throw SceneError(line.target + ": holds a study; diptych study with its file and --resume evaluates it again");
      if (is_calibration_folder(line.target))
        throw SceneError(line.target + ": holds a calibration; diptych calibrate with its file and --resume evaluates it again");
      for (const std::string &text : line.overrides)
        if (text.rfind("comparison/", 0) != 0 && text.rfind("output/", 0) != 0)
          throw SceneError("--set " + text + ": only comparison/ and output/ can be changed without running the panels again");
        else if (text.rfind("comparison/coarse_element_size=", 0) == 0)
          throw SceneError("--set " + text +
                           ": the continuum on the coarse mesh must be computed again; use diptych run --resume");
        else if (text.rfind("output/directory=", 0) == 0)
          throw SceneError("--set " + text + ": a comparison is written into its own result folder");
      Scene scene            = read_computed_scene(scene_prm(line.target), line.overrides);
      scene.output.directory = line.target;
      if (const std::string name = recorded_scene(line.target); !name.empty())
        scene.name = name;
      return scene;
    }
  } // namespace

  void check_comparable(const Scene &scene)
  {
    if (scene.continuum.mesh.kind != continuum::MeshOption::Kind::outline)
      throw SceneError("continuum/mesh = " + text_of(scene.continuum.mesh) +
                       ": `diptych run` compares both panels on one sample and needs outline; `diptych continuum` runs only "
                       "the continuum");
  }

  int compare_and_report(const CommandLine &line, const Scene &scene, const Results &results, const std::string &next)
  {
    const std::string &directory = scene.output.directory;
    const bool         replaces  = std::filesystem::exists(comparison_json(directory));
    std::string        text;
    const int          code  = comparison_of(line, scene, results, next, text);
    const bool         draws = code == done && scene.output.report;
    try
      {
        const PhaseTimer timer(report_phase);
        if (draws)
          {
            Progress progress(line.quiet);
            progress.update("drawing the report", 0);
            draw_page(directory, next);
            progress.finish();
            record_phases(next, origin_of(line, scene), {timer.stop()});
          }
      }
    catch (const std::exception &)
      {
        if (!replaces) // a comparison without its page is better than none
          take(directory, next);
        throw;
      }
    take(directory, next);
    if (replaces)
      say(line, "the new comparison has replaced the earlier one in " + directory);
    say(line, text);
    if (draws)
      say(line, "report: " + report_file(directory));
    return code;
  }

  int compare_again(const CommandLine &line)
  {
    if (!is_result_folder(line.target) && !std::filesystem::exists(scene_prm(line.target)))
      throw SceneError(line.target + " is not a result folder; diptych run SCENE makes one");
    if (!std::filesystem::exists(continuum_csv(line.target)))
      throw SceneError(line.target + ": holds no continuum yet; diptych run " + scene_prm(line.target) +
                       " computes it beside the grains and compares, diptych element the point of the law beside a cell");
    return writing(line.target, [&](FolderLock &) {
      finish_move(line.target);
      check_scene_file(line.target);
      const Scene scene = scene_of_folder(line);
      return compare_and_report(line, scene, load_results(line.target), next_comparison(line.target));
    });
  }
} // namespace diptych::coupling
