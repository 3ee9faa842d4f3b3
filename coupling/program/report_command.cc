// diptych: pictures and pages, drawn by the Python package of the report
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/report_command.h"

#include <filesystem>
#include <stdexcept>

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

    const char *word_of(const Drawing drawing)
    {
      switch (drawing)
        {
        case Drawing::page:
          return "page";
        case Drawing::ensemble:
          return "ensemble";
        case Drawing::study:
          return "study";
        case Drawing::calibration:
          return "calibration";
        case Drawing::homogenised:
          return "homogenised";
        case Drawing::element:
          return "element";
        default:
          return "movie";
        }
    }

    // Removes unfinished files of a drawing that failed.
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

  void draw(const Drawing drawing, const std::string &directory, const std::string &next)
  {
    const std::string &into = next.empty() ? directory : next;
    int                code = 0;
    use_python_package("report");
    try
      {
        code = run_program({python, "-m", "diptych.report", word_of(drawing), directory, into});
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
      throw std::runtime_error("the report could not be drawn: " + std::string(python) + " -m diptych.report " +
                               word_of(drawing) + " " + directory + " ended with exit code " + std::to_string(code));
  }

  int report_again(const CommandLine &line)
  {
    if (std::error_code none; !fs::is_directory(line.target, none))
      throw SceneError(line.target + " is not a result folder; diptych run SCENE makes one");
    const Drawing drawing = is_study_folder(line.target)         ? Drawing::study
                            : is_calibration_folder(line.target) ? Drawing::calibration
                            : is_ensemble_folder(line.target)    ? Drawing::ensemble
                            : is_homogenised_folder(line.target) ? Drawing::homogenised
                            : is_element_folder(line.target)     ? Drawing::element
                                                                 : Drawing::page;
    if (drawing == Drawing::page && !fs::exists(comparison_json(line.target)))
      throw SceneError(line.target + " is not a result folder (no comparison.json), nor the folder of an ensemble, a study, a "
                                     "calibration, an element or homogenised grains");
    if (drawing == Drawing::page)
      {
        check_files(line.target);
        check_files(line.target, "comparison");
      }
    if (line.draws_movie && drawing != Drawing::page)
      throw SceneError("report " + line.target + " --movie: only a result folder with both panels has a movie");
    if (drawing == Drawing::ensemble)
      check_files(line.target, "ensemble");
    return writing(line.target, [&](FolderLock &) {
      Progress progress(line.quiet);
      progress.update("drawing the report", 0);
      draw(drawing, line.target);
      if (line.draws_movie)
        draw(Drawing::movie, line.target);
      progress.finish();
      say(line, "report: " + report_file(line.target));
      return int(done);
    });
  }
} // namespace diptych::coupling
