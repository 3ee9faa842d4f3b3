// diptych: results of one run of a study, read from its folder
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "coupling/statistics/history_table.h"
#include "coupling/store/facts.h"
#include "coupling/studies/study_folder.h"

namespace diptych::coupling
{
  struct RunResult
  {
    bool                   is_known   = false; // it ended; else interrupted or never started
    bool                   is_refused = false; // its settings contradict each other
    int                    exit_code  = 0;
    std::string            words;                // last line of its log if it did not finish; reason of the refusal
    bool                   warned       = false; // a panel warned
    int                    halved_steps = 0;     // of the grains
    double                 cut_backs    = 0;     // of the continuum
    double                 sweeps = NAN, newton_iterations = NAN;
    double                 load    = NAN; // of the machine at the end
    int                    at_once = 1;
    std::vector<PhaseCost> phases;
    std::vector<double>    values; // one per quantity; NaN if there is none
  };

  // results[point][sample]
  using StudyResults = std::vector<std::vector<RunResult>>;

  // Rows of a panel's table in a result folder; every row has `progress`. Empty if there is no table.
  HistoryTable panel_table(const std::string &folder, Source source);

  // Throws std::invalid_argument naming a damaged file.
  RunResult result_of(const std::string &directory, const Study &study, const StudyRun &run);
} // namespace diptych::coupling
