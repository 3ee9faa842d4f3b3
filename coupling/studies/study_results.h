// diptych: what a run of a study says, read from its folder
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
    bool                   is_known   = false; // it ended; else it was interrupted or never begun
    bool                   is_refused = false; // its settings contradict each other
    int                    exit_code  = 0;
    std::string            words;                // the last ones of its log where it did not finish; why it was refused
    bool                   warned       = false; // a panel warned
    int                    halved_steps = 0;     // of the grains
    double                 cut_backs    = 0;     // of the continuum
    double                 sweeps = NAN, newton_iterations = NAN;
    double                 load    = NAN; // of the machine at its end
    int                    at_once = 1;
    std::vector<PhaseCost> phases;
    std::vector<double>    values; // one a quantity; NaN where there is none
  };

  // Rows of a panel's table in a result folder, with `progress` in every one; empty where there is none.
  HistoryTable panel_table(const std::string &folder, Source source);

  // Throws std::invalid_argument naming a file that is broken.
  RunResult result_of(const std::string &directory, const Study &study, const StudyRun &run);
} // namespace diptych::coupling
