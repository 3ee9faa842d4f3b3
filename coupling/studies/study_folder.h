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
  // DIR/runs/NAME: the result folder of a run; beside it its scene NAME.prm, its output NAME.log and how it ended, NAME.json.
  std::string run_folder(const std::string &directory, const StudyRun &run);
  std::string run_scene(const std::string &directory, const StudyRun &run);
  std::string run_log(const std::string &directory, const StudyRun &run);

  // Folders that hold runs: what they are of, the copy of the file that asked for it, tables that are made of the runs.
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

  // How a run ended.
  struct RunEnd
  {
    int         exit_code = 0;
    std::string revision;      // of the program
    double      load    = NAN; // processes ready to run on the machine, mean over the last minute before the end
    int         at_once = 1;   // runs that this study had at work
  };
  void write_end(const std::string &directory, const StudyRun &run, int exit_code, int at_once);

  // Nothing where the run has not ended, was ended by a signal or by the system (no room, no memory), or belongs to another
  // revision of the program or another scene, or where its files are not known to be as it left them: then it is to be run.
  [[nodiscard]] std::optional<RunEnd> found_end(const std::string &directory, const StudyRun &run);

  // Makes a run ready: its scene is written, an old log is taken away. Its folder stays only where this revision of the program
  // was interrupted in it; returns whether there is one to go on from.
  [[nodiscard]] bool prepare_run(const std::string &directory, const StudyRun &run);

  // The same from the beginning, whatever stands there.
  void prepare_run_anew(const std::string &directory, const StudyRun &run);
} // namespace diptych::coupling
