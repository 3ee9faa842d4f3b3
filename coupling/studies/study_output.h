// diptych: result files of a study
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include "coupling/numbers/number_entry.h"
#include "coupling/studies/study_cost.h"

namespace diptych::coupling
{
  struct StudyTables
  {
    const Study                   &study;
    const std::vector<ScenePoint> &points;
    const StudyResults            &results;
    const StudyRecord             &record;
  };

  // study.json: points, errors, classes and orders. Its bits do not depend on when, where or in which order the points ran.
  void write_study_json(const std::string &directory, const StudyTables &tables);

  // study.csv: one line per point and sample.
  void write_study_csv(const std::string &directory, const StudyTables &tables);

  // study_cost.json: CPU times and what follows from them.
  void write_study_cost(const std::string &directory, const StudyCost &cost);

  // Columns of study.csv. After `folder` each quantity has its value and its error against the reference on the same sample.
  // Then each phase has its CPU time.
  inline std::array<NumberEntry, 12> study_columns()
  {
    return {{{"point", "-", "index of the point in study.json"},
             {"family", "-", "family of the point"},
             {"settings", "-", "settings beyond those of all points, separated by ;"},
             {"sample", "-", "seed of the sample; empty: the one sample of the scene"},
             {"class", "-", "class of the point, from all its samples"},
             {"exit_code", "-", "exit code of this run; empty: not run"},
             {"halved_steps", "-", "halved steps of the grains"},
             {"cut_backs", "-", "halved load steps of the continuum"},
             {"sweeps", "-", "sweeps of the contact solver"},
             {"newton_iterations", "-", "Newton iterations of the continuum"},
             {"peak_memory_mb", "MB", "peak memory of the run"},
             {"folder", "-",
              "result folder of the run; then for each quantity its value and its error against the reference (relative [-] "
              "unless the limit is absolute), and for each phase its CPU time [s]"}}};
  }
} // namespace diptych::coupling
