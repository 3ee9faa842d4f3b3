// diptych: running means of every member of an ensemble, and of all together
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "coupling/numbers/array_entry.h"
#include "coupling/scene/scene.h"

namespace diptych::coupling
{
  // One quantity of one panel. NaN where a history does not reach.
  struct EnsembleCurves
  {
    std::vector<std::vector<double>> members;         // [member][point of the grid]
    std::vector<double>              mean, low, high; // of all members, with the ends of its 95 % Student interval
  };

  template <class Visit> void list_curve_arrays(const EnsembleCurves &c, Visit &&visit)
  {
    visit(ArrayEntry{"members", "every member", "-", "running mean, a row a seed; nan where a history does not reach"},
          c.members);
    visit(ArrayEntry{"mean", "mean", "-", "of all members; nan where not all have a value"}, c.mean);
    visit(ArrayEntry{"low", "lower end", "-", "of the 95 % Student interval of the mean; nan as there"}, c.low);
    visit(ArrayEntry{"high", "upper end", "-", "of the same interval; nan as there"}, c.high);
  }

  // What all curves have in common.
  struct EnsembleGrid
  {
    std::vector<double> progress;
    std::vector<int>    seeds; // of the rows of `members`
    double              averaging_width = 0;
  };

  template <class Visit> void list_grid(const EnsembleGrid &g, Visit &&visit)
  {
    visit(ArrayEntry{"progress", "progress", "as walk says", "points of the curves"}, g.progress);
    visit(ArrayEntry{"seeds", "seeds", "-", "of the members, a row each"}, g.seeds);
    visit(NumberEntry{"averaging_width", "as walk says", "of the running means"}, g.averaging_width);
  }

  // At every point where all members have a value.
  EnsembleCurves with_means(std::vector<std::vector<double>> members);

  // ensemble.h5: progress (401 points), and for each panel and each of stress_ratio and volumetric_strain the running means of
  // the members' histories, their mean and its interval. `seeds`: those that finished.
  void write_ensemble_curves(const std::string &directory, const Scene &scene, const std::vector<int> &seeds);

  // Throws std::invalid_argument naming the first of the members' histories that those could not be drawn of.
  void check_member_histories(const std::string &directory, const std::vector<int> &seeds);
} // namespace diptych::coupling
