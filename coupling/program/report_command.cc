// diptych: pictures and pages, drawn by the Python package of the report
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/report_command.h"

#include <filesystem>
#include <stdexcept>
#include <vector>

#include "coupling/processes/child_process.h"
#include "coupling/processes/progress.h"
#include "coupling/processes/stop_signal.h"
#include "coupling/program/commands.h"
#include "coupling/program/python_package.h"
#include "coupling/scene/scene_error.h"
#include "coupling/store/file_names.h"
#include "coupling/store/provenance.h"
#include "coupling/store/result_folder.h"
#include "coupling/version.h"

namespace diptych::coupling
{
  namespace
  {
    namespace fs = std::filesystem;

    // A process that is killed leaves the file that it was writing.
    void remove_parts(const std::string &directory)
    {
      for (const char *name : {"report.html.part", "movie.gif.part"})
        fs::remove(directory + "/" + name);
    }
  } // namespace

  std::string report_file(const std::string &directory)
  {
    return fs::absolute(report_html(directory)).lexically_normal().string();
  }

  void draw(const std::string &what, const std::string &directory, const std::string &next)
  {
    const std::string       &into  = next.empty() ? directory : next;
    std::vector<std::string> words = {python, "-m", "diptych.report", what, directory};
    if (!next.empty())
      words.push_back(next);
    int code = 0;
    use_python_package("report");
    try
      {
        code = run_program(words);
      }
    catch (const StoppedOnRequest &)
      {
        remove_parts(into);
        throw StoppedOnRequest("drawing the report: stopped on request; to draw it: diptych " +
                               std::string(next.empty() ? "report " : "compare ") + directory);
      }
    if (code != 0)
      remove_parts(into);
    if (code == wrong_input)
      throw std::invalid_argument(directory + ": the report could not be drawn");
    if (code != 0)
      throw std::runtime_error("the report could not be drawn: " + std::string(python) + " -m diptych.report " + what + " " +
                               directory + " ended with exit code " + std::to_string(code));
  }

  int report_again(const CommandLine &line)
  {
    if (std::error_code none; !fs::is_directory(line.target, none))
      throw SceneError(line.target + " is not a result folder; diptych run SCENE makes one");
    const std::string what = is_study_folder(line.target)         ? "study"
                             : is_calibration_folder(line.target) ? "calibration"
                             : is_ensemble_folder(line.target)    ? "ensemble"
                             : is_homogenised_folder(line.target) ? "homogenised"
                             : is_element_folder(line.target)     ? "element"
                                                                  : "page";
    if (what == "page" && !fs::exists(comparison_json(line.target)))
      throw SceneError(line.target + " is not a result folder (no comparison.json), nor the folder of an ensemble, a study, a "
                                     "calibration, an element or homogenised grains");
    if (what == "page")
      {
        check_files(line.target);
        check_files(line.target, "comparison");
      }
    if (line.draws_movie && what != "page")
      throw SceneError("report " + line.target + " --movie: only a result folder with both panels has a movie");
    if (what == "ensemble")
      check_files(line.target, "ensemble");
    return writing(line.target, [&](FolderLock &) {
      Progress progress(line.quiet);
      progress.update("drawing the report", 0);
      draw(what, line.target);
      if (line.draws_movie)
        draw("movie", line.target);
      progress.finish();
      say(line, "report: " + report_file(line.target));
      return int(done);
    });
  }
} // namespace diptych::coupling
