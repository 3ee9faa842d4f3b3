// diptych: running means of every member of an ensemble, and their mean
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "coupling/numbers/array_entry.h"
#include "coupling/scene/scene.h"

namespace diptych::coupling
{
  // One quantity of one panel. NaN beyond the end of a history.
  struct EnsembleCurves
  {
    std::vector<std::vector<double>> members;         // [member][index of the grid]
    std::vector<double>              mean, low, high; // of all members, with its 95 % Student interval
  };

  template <class Visit> void list_curve_arrays(const EnsembleCurves &c, Visit &&visit)
  {
    visit(ArrayEntry{"members", "every member", "-", "running mean, one row per seed; nan beyond the end of a history"},
          c.members);
    visit(ArrayEntry{"mean", "mean", "-", "mean over all members; nan if a member has no value"}, c.mean);
    visit(ArrayEntry{"low", "lower end", "-", "lower end of the 95 % Student interval of the mean; nan like the mean"}, c.low);
    visit(ArrayEntry{"high", "upper end", "-", "upper end of the same interval; nan like the mean"}, c.high);
  }

  // The grid that all curves share.
  struct EnsembleGrid
  {
    std::vector<double> progress;
    std::vector<int>    seeds; // of the rows of `members`
    double              averaging_width = 0;
  };

  template <class Visit> void list_grid(const EnsembleGrid &g, Visit &&visit)
  {
    visit(ArrayEntry{"progress", "progress", "as walk says", "points of the curves"}, g.progress);
    visit(ArrayEntry{"seeds", "seeds", "-", "seeds of the members, one per row"}, g.seeds);
    visit(NumberEntry{"averaging_width", "as walk says", "width of the running means"}, g.averaging_width);
  }

  // Adds mean and interval at every point where all members have a value.
  EnsembleCurves with_means(std::vector<std::vector<double>> members);

  // Writes ensemble.h5: progress (401 points), and for stress_ratio and volumetric_strain of each panel the running means of
  // all members, their mean and its interval. `seeds`: the finished members.
  void write_ensemble_curves(const std::string &directory, const Scene &scene, const std::vector<int> &seeds);

  // Throws std::invalid_argument naming the first history of a member that is missing or damaged.
  void check_member_histories(const std::string &directory, const std::vector<int> &seeds);
} // namespace diptych::coupling
