// diptych: one sample loaded with several lengths of the step, compared
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "coupling/numbers/number_entry.h"
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
    std::vector<double>   steps; // of the runs [time]
    std::vector<Quantity> quantities;
    double                largest = 0; // of the coarsest run, over all quantities
    double                margin  = 0; // up to where the step is said not to matter
    std::string           verdict;
    double                window = 0; // of the running means [time]
  };

  template <class Visitor> void list_numbers(const StepComparison::Quantity &q, Visitor &v)
  {
    v({"name", "-", "column of discrete.csv"}, q.name);
    v({"largest_difference", "-", "of each run from the finest, over the largest stress ratio or external work of that"},
      q.largest_difference);
    v({"at_progress", "as walk says", "where the coarsest run differs most"}, q.at_progress);
  }
  template <class Visitor> void list_numbers(const StepComparison &c, Visitor &v)
  {
    v({"steps", "time", "length of the step of each run, from the coarsest"}, c.steps);
    v.list("quantities", "what is compared, at equal times", c.quantities);
    v({"largest_difference", "-", "of the coarsest run, over all quantities"}, c.largest);
    v({"margin", "-", "up to where the step is said not to matter"}, c.margin);
    v({"verdict", "-", "whether the step matters, in words"}, c.verdict);
  }

  // Columns of study_step.csv, a row an instant of a run.
  std::vector<NumberEntry> step_study_columns();

  // Runs from the coarsest to the finest, all loaded along `walk`; `width`: of the running means, in its unit. Throws
  // std::invalid_argument for fewer than two.
  StepComparison compare_steps(const std::vector<StepRun> &runs, double width, discrete::Walk walk);

  // study_step.csv and study_step.json.
  void write_step_comparison(const std::string &directory, const std::vector<StepRun> &runs, const StepComparison &comparison);
} // namespace diptych::coupling
