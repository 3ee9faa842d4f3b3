// diptych: a study as files
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

  // study.json: points, errors, classes and orders; the same bits whenever, wherever and in whatever order the points ran.
  void write_study_json(const std::string &directory, const StudyTables &tables);

  // study.csv: a line a point and sample.
  void write_study_csv(const std::string &directory, const StudyTables &tables);

  // study_cost.json: CPU seconds and what follows from them.
  void write_study_cost(const std::string &directory, const StudyCost &cost);

  // Columns of study.csv; after `folder` stand for each quantity its value and its error against the reference on the same
  // sample, then one a phase: its CPU seconds.
  inline std::array<NumberEntry, 12> study_columns()
  {
    return {
      {{"point", "-", "its place in study.json"},
       {"family", "-", "of the point"},
       {"settings", "-", "beyond those of all points, separated by ;"},
       {"sample", "-", "its seed; empty: the one of the scene"},
       {"class", "-", "of the point, over all samples"},
       {"exit_code", "-", "of this run; empty: not run"},
       {"halved_steps", "-", "of the grains"},
       {"cut_backs", "-", "of the continuum"},
       {"sweeps", "-", "of the contact solver"},
       {"newton_iterations", "-", "of the continuum"},
       {"peak_memory_mb", "MB", "of the run"},
       {"folder", "-", "of the run; then a column a quantity, its difference from the reference, and CPU seconds a phase"}}};
  }
} // namespace diptych::coupling
