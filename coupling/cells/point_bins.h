// diptych: points sorted into square bins
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Core>

#include "coupling/cells/bin_grid.h"

namespace diptych::coupling
{
  // The order is deterministic: bins row by row from below, points ascending in each bin.
  class PointBins
  {
  public:
    // bin_size > 0. Without points there are no bins. If the points lie so far apart that most bins would be empty, the bins are
    // larger than bin_size.
    PointBins(const std::vector<Eigen::Vector2d> &position, const double bin_size)
    {
      if (position.empty())
        return;
      Eigen::Vector2d lower = position.front(), upper = lower;
      for (const Eigen::Vector2d &x : position)
        {
          lower = lower.cwiseMin(x);
          upper = upper.cwiseMax(x);
        }
      const double          most   = 4096 + 64 * double(position.size());
      const Eigen::Vector2d extent = upper - lower;
      const double needed = std::max({bin_size, extent.maxCoeff() / most, std::sqrt(extent.x() / most) * std::sqrt(extent.y())});
      grid                = BinGrid(lower, upper, needed);
      grid.sort(position.size(), [&](const unsigned int i, const auto &into) { into(grid.bin_of(position[i])); });
    }

    double bin_size() const { return grid.bin_size(); }

    // Visits the points in bins at a Chebyshev distance of `ring` bins from the bin of x. Returns false if no bin lies at this
    // distance. All points closer to x than (ring + 1) bin sizes are in the rings 0 .. ring + 1.
    template <class Action> bool for_each_in_ring(const Eigen::Vector2d &x, const int ring, Action &&action) const
    {
      const int row = grid.row_of(x), column = grid.column_of(x);
      bool      any = false;
      for (int r = std::max(0, row - ring); r <= std::min(grid.n_rows() - 1, row + ring); ++r)
        {
          const int step = r == row - ring || r == row + ring ? 1 : 2 * ring; // all columns in the first and last row, two bins
                                                                              // in the others
          for (int c = column - ring; c <= column + ring; c += std::max(1, step))
            if (c >= 0 && c < grid.n_columns())
              {
                any = true;
                grid.for_each_in(grid.number(r, c), action);
              }
        }
      return any;
    }

    // Visits the points in all bins that meet the square of half side `reach` around x.
    template <class Action> void for_each_near(const Eigen::Vector2d &x, const double reach, Action &&action) const
    {
      const Eigen::Vector2d half = Eigen::Vector2d::Constant(reach);
      grid.for_each_in(grid.range(x - half, x + half), action);
    }

  private:
    BinGrid grid;
  };
} // namespace diptych::coupling
