// diptych: running means of every member of an ensemble, and of all together
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "coupling/scene/scene.h"

namespace diptych::coupling
{
  // One quantity of one panel. NaN where a history does not reach.
  struct EnsembleCurves
  {
    std::vector<std::vector<double>> members;         // [member][point of the grid]
    std::vector<double>              mean, low, high; // of all members, with the ends of its 95 % Student interval
  };

  // At every point where all members have a value.
  EnsembleCurves with_means(std::vector<std::vector<double>> members);

  // ensemble.h5: progress (401 points), and for each panel and each of stress_ratio and volumetric_strain the running means of
  // the members' histories, their mean and its interval. `seeds`: those that finished.
  void write_ensemble_curves(const std::string &directory, const Scene &scene, const std::vector<int> &seeds);
} // namespace diptych::coupling
