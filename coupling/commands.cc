// diptych: what the program can be asked to do
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/commands.h"

#include <filesystem>
#include <fstream>
#include <iostream>

#include <nlohmann/json.hpp>

#include "coupling/comparison/comparison.h"
#include "coupling/comparison/comparison_output.h"
#include "coupling/continuum_command.h"
#include "coupling/continuum_loading.h"
#include "coupling/discrete_command.h"
#include "coupling/progress.h"
#include "coupling/provenance.h"
#include "coupling/result_folder.h"

namespace diptych::coupling
{
  namespace
  {
    using nlohmann::json;

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
      write_comparison_h5(directory, scene, c);
      write_fields_vtu(directory, c);
      update_provenance(directory, scene, line.text, {timer.stop()}, json::object());
      write_comparison(directory, scene, c, read_provenance(directory));
      progress.finish();
      for (const StageRecord &stage : c.stages)
        if (!(stage.mapping.total_relative_error < 1e-12))
          {
            std::cerr << "the mapping at " << reached(stage.axial_strain) << " misses the grains' total by "
                      << stage.mapping.total_relative_error << std::endl;
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

  void check_comparable(const CommandLine &line, const Scene &scene)
  {
    require_continuum(scene);
    if (scene.comparison.coarse_element_size == 0)
      throw SceneError("comparison/coarse_element_size = 0: `diptych run` compares with that run; a number from 0.1 on");
    if (scene.continuum.mesh != "outline")
      throw SceneError("continuum/mesh = " + scene.continuum.mesh +
                       ": `diptych run` compares both panels on one sample and needs outline; the continuum alone runs with "
                       "`diptych continuum`");
    if (!line.study.empty())
      throw SceneError("--study " + line.study + ": only `diptych discrete` has studies");
  }

  int run_both(const CommandLine &line)
  {
    const Scene scene = scene_of(line);
    check_comparable(line, scene);
    const bool resume_continuum = line.resume && may_resume_continuum(scene);
    open_result_folder(scene, line.resume);
    if (const int code = discrete_panel(line, scene); code != done)
      return code;
    if (const int code = continuum_panel(line, scene, {true, resume_continuum}); code != done)
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
