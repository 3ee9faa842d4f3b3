// diptych: one sample loaded with several lengths of the step, compared
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "coupling/statistics/history_table.h"
#include "discrete/walk.h"

namespace diptych::coupling
{
  // The history of one run; `step` is h as it was asked for [time].
  struct StepRun
  {
    double       step;
    HistoryTable history;
  };

  // What halving the step changes (Moreau 1997: compare energy against time). Energies are cumulated since the start of the
  // loading; stress ratios are running means, because single steps of rigid grains scatter; all is
  // compared at equal times.
  struct StepComparison
  {
    struct Quantity
    {
      std::string         name;               // column of discrete.csv
      std::vector<double> largest_difference; // of each run from the finest, relative to its largest stress ratio or,
                                              // for energies, to its largest external work
      double at_progress = 0;                 // where the coarsest run differs most
    };
    std::vector<Quantity> quantities;
    double                largest = 0; // of the coarsest run, over all quantities
    std::string           verdict;
    double                window = 0; // of the running means [time]
  };

  // Runs from the coarsest to the finest, all loaded along `walk`; `width`: of the running means, in its unit. Throws
  // std::invalid_argument for fewer than two.
  StepComparison compare_steps(const std::vector<StepRun> &runs, double width, discrete::Walk walk);

  // study_step.csv (progress, time, and for every run stress ratio and its running mean, external work, dissipations, kinetic
  // energy) and study_step.json.
  void write_step_comparison(const std::string &directory, const std::vector<StepRun> &runs, const StepComparison &comparison);
} // namespace diptych::coupling
