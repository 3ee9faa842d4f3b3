// diptych: dependence of the grains' stress on the averaging length
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "coupling/averaging/averaging_options.h"
#include "coupling/cells/mesh_cells.h"
#include "discrete/snapshot.h"

namespace diptych::coupling
{
  struct StudyPoint
  {
    std::string     name;
    Eigen::Vector2d position; // [length]
  };

  // s = (s1 + s2)/2 and t = (s1 - s2)/2 of the symmetric part; s is positive in compression.
  struct PointStress
  {
    std::string name;
    double      s = 0, t_over_s = 0; // [pressure], [-]; NaN if there is no value
  };

  struct ResolutionRow
  {
    double                   width = 0;                    // mean diameters
    std::vector<PointStress> points;                       // in the order of the given points
    double                   scatter_s = 0, scatter_t = 0; // standard deviation / mean over the covered cells, by area
  };

  struct ResolutionStudy
  {
    // width: standard deviation of the kernel. The values hold at the points themselves. The scatter is that of the values at the
    // centres of the covered cells of a regular grid of 2 d.
    std::vector<ResolutionRow> kernel;
    // width: side of the cells of a regular grid, with the stress by `segments`. A point has the value of the cell that holds it.
    // This value is taken over the part of the cell inside the mesh, which must be at least half.
    std::vector<ResolutionRow> cells;

    std::optional<std::array<double, 2>> plateau; // range of kernel widths [mean diameters]
    std::string                          verdict;
  };

  inline const std::vector<double> kernel_widths = {0.5, 0.75, 1, 1.5, 2, 3, 4};    // mean diameters
  inline const std::vector<double> cell_sizes    = {0.5, 0.75, 1, 1.5, 2, 3, 4, 6}; // mean diameters

  // Uses the window forces of a snapshot, without the dynamic part of the stress. `mesh`: the region that the sample fills.
  ResolutionStudy resolution_study(const QuadMesh                &mesh,
                                   const discrete::Snapshot      &grains,
                                   const std::vector<StudyPoint> &points,
                                   KernelShape                    kernel = KernelShape::gauss);

  // The widest range of widths (by ratio) in which s and t/s of every point stay within 5 % of their mean. It has at least a
  // factor of two. The mean is over the rows in the range, and the ends of the range are widths of rows. Of equally wide
  // ranges, the one of smallest widths is taken. A mean t/s below 0.1 counts as 0.1. Empty without points.
  std::optional<std::array<double, 2>> find_plateau(const std::vector<ResolutionRow> &rows);
} // namespace diptych::coupling
