// diptych: curves of the points of a study
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "coupling/numbers/array_entry.h"
#include "coupling/studies/study_output.h"

namespace diptych::coupling
{
  // The progress that all curves of a panel share.
  struct StudyGrid
  {
    std::vector<double> progress;
    double              averaging_width = 0;
  };
  template <class Visit> void list_grid(const StudyGrid &g, Visit &&visit)
  {
    visit(ArrayEntry{"progress", "progress", "as walk says", "points of the curves"}, g.progress);
    visit(NumberEntry{"averaging_width", "as walk says", "width of the running means"}, g.averaging_width);
  }

  struct StudyCurves
  {
    std::vector<std::vector<double>> stress_ratio, volumetric_strain; // [point][index of the grid]
  };
  template <class Visit> void list_curve_arrays(const StudyCurves &c, Visit &&visit)
  {
    visit(ArrayEntry{"stress_ratio", "stress ratio t/s", "-",
                     "running mean, averaged over the samples, one row per point; nan if a sample has no value"},
          c.stress_ratio);
    visit(
      ArrayEntry{
        "volumetric_strain", "volumetric strain", "-",
        "running mean, averaged over the samples, one row per point; dilation negative; nan beyond the end of a history"},
      c.volumetric_strain);
  }

  // Writes study.h5 with a group for each panel that ran (discrete, continuum, material_point).
  void write_study_curves(const std::string &directory, const StudyTables &tables);
} // namespace diptych::coupling
