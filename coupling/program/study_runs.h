// diptych: the runs of a study's points, on workers, and what they gave
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "coupling/processes/task_queue.h"
#include "coupling/program/command_line.h"
#include "coupling/studies/study_folder.h"
#include "coupling/studies/study_points.h"
#include "coupling/studies/study_results.h"

namespace diptych::coupling
{
  // A study with its points and its folder.
  struct StudyPoints
  {
    Study                   study;
    std::vector<ScenePoint> points;
    std::string             directory;
  };

  // What its runs read.
  InputFiles inputs_of(const StudyPoints &asked);

  // Does the runs that are not finished in the folder, which is open. Collective; the outcomes are the first process's.
  std::vector<TaskOutcome> do_runs(const CommandLine &line, const StudyPoints &asked);

  StudyResults results_of(const StudyPoints &asked);
} // namespace diptych::coupling
