// diptych: comparison of runs of one sample with different lengths of the step
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "coupling/numbers/number_entry.h"
#include "coupling/statistics/history_table.h"
#include "discrete/loading_variable.h"

namespace diptych::coupling
{
  // The history of one run. `step` is the length h that was requested [time].
  struct StepRun
  {
    double       step;
    HistoryTable history;
  };

  // The effect of halving the step (Moreau 1997: compare energy over time). Energies are cumulated from the start of the loading.
  // Stress ratios are running means, because single steps of rigid grains scatter. All quantities are compared at equal times.
  struct StepComparison
  {
    struct Quantity
    {
      std::string         name;               // column of discrete.csv
      std::vector<double> largest_difference; // difference of each run from the finest, relative to the finest run's largest
                                              // stress ratio or, for energies, to its largest external work
      double at_progress = 0;                 // progress at which the coarsest run differs most
    };
    std::vector<double>   steps; // steps of the runs [time]
    std::vector<Quantity> quantities;
    double                largest = 0; // largest difference of the coarsest run over all quantities
    double                margin  = 0; // largest difference at which the step does not matter
    std::string           verdict;
    double                window = 0; // window of the running means [time]
  };

  template <class Visitor> void list_numbers(const StepComparison::Quantity &q, Visitor &v)
  {
    v({"name", "-", "column of discrete.csv"}, q.name);
    v({"largest_difference", "-",
       "largest difference of each run from the finest, relative to the finest run's largest stress ratio or external work"},
      q.largest_difference);
    v({"at_progress", "strain or time", "progress at which the coarsest run differs most"}, q.at_progress);
  }
  template <class Visitor> void list_numbers(const StepComparison &c, Visitor &v)
  {
    v({"steps", "time", "length of the step of each run, from the coarsest"}, c.steps);
    v.list("quantities", "quantities that are compared at equal times", c.quantities);
    v({"largest_difference", "-", "largest difference of the coarsest run over all quantities"}, c.largest);
    v({"margin", "-", "largest difference at which the step does not matter"}, c.margin);
    v({"verdict", "-", "verdict on whether the step matters"}, c.verdict);
  }

  // Columns of study_step.csv, one row per instant of a run.
  std::vector<NumberEntry> step_study_columns();

  // Runs from the coarsest to the finest, all loaded along `loading_variable`. `width`: range of the running means in the unit of
  // `loading_variable`. Throws std::invalid_argument for fewer than two runs.
  StepComparison compare_steps(const std::vector<StepRun> &runs, double width, discrete::LoadingVariable loading_variable);

  // Writes study_step.csv and study_step.json.
  void write_step_comparison(const std::string &directory, const std::vector<StepRun> &runs, const StepComparison &comparison);
} // namespace diptych::coupling
