// diptych: the folder of a study and of its runs
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "coupling/scene/scene_error.h"
#include "coupling/store/result_folder.h"
#include "coupling/studies/study_points.h"

namespace diptych::coupling
{
  // DIR/runs/NAME is the result folder of a run. Beside it are its scene NAME.prm, its log NAME.log and its end NAME.json.
  std::string run_folder(const std::string &directory, const StudyRun &run);
  std::string run_scene(const std::string &directory, const StudyRun &run);
  std::string run_log(const std::string &directory, const StudyRun &run);

  // Kinds of folders that hold runs: name, copy of the input file, and tables made from the runs.
  struct RunsFolder
  {
    std::string              noun, input;
    std::vector<std::string> tables;
  };
  inline const RunsFolder folder_of_a_study = {"study",
                                               "study_input.json",
                                               {"study.json", "study.csv", "study.h5", "study_cost.json", "report.html"}};

  inline const RunsFolder folder_of_a_calibration = {
    "calibration",
    "calibration_input.json",
    {"calibration.json", "calibration.csv", "calibration_cost.json", "calibrated.prm", "report.html", "meshes"}};

  bool is_calibration_folder(const std::string &directory);
  bool is_study_folder(const std::string &directory);

  // Prepares the folder and copies `file`, which asks for the runs, there. Runs that stand there stay, and finished ones are used
  // again. Throws as require_usable() and set_aside() do.
  void open_runs_folder(FolderLock        &lock,
                        const RunsFolder  &kind,
                        const std::string &file,
                        const Opening     &opening,
                        const InputFiles  &inputs);

  // The end of a run.
  struct RunEnd
  {
    int         exit_code = 0;
    std::string revision;      // of the program
    double      load    = NAN; // processes ready to run on the machine, mean over the last minute
    int         at_once = 1;   // runs of this study at work
  };
  void write_end(const std::string &directory, const StudyRun &run, int exit_code, int at_once);

  // Empty if the run must be done (again): it has not ended; a signal or the system ended it (no space, no memory); program or
  // scene differ; or its files may have changed since.
  [[nodiscard]] std::optional<RunEnd> found_end(const std::string &directory, const StudyRun &run);

  // Prepares a run: writes its scene and removes an old log. The folder stays only if this revision of the program was
  // interrupted in it. Returns true if the run can be resumed.
  [[nodiscard]] bool prepare_run(const std::string &directory, const StudyRun &run);

  // Prepares the run to start from the beginning.
  void prepare_run_anew(const std::string &directory, const StudyRun &run);
} // namespace diptych::coupling
