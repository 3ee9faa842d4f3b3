// diptych: one function per averaging method. distribute() checks the sizes and wraps the centres into the mesh.
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "coupling/averaging/averaging_options.h"
#include "coupling/averaging/carriers.h"
#include "coupling/averaging/target_cells.h"

namespace diptych::coupling
{
  CellSums average_by_segments(const TargetCells &target, const Carriers &carriers);
  CellSums average_by_centroid(const TargetCells &target, const Carriers &carriers);
  CellSums average_by_laguerre(const TargetCells &target, const Carriers &carriers);
  // width: standard deviation [length]
  CellSums average_by_kernel(const TargetCells &target, const Carriers &carriers, KernelShape shape, double width);
  CellSums average_by_projection(const TargetCells &target, const Carriers &carriers, double width);

  CellSums zero_sums(const TargetCells &target, const Carriers &carriers);

  // Shares of grains in cells as compressed rows; each row sums to one.
  struct GrainShares
  {
    std::vector<std::size_t>  begin = {0}; // n_grains + 1
    std::vector<unsigned int> cell;
    std::vector<double>       share;
    std::vector<bool>         outside; // n_grains: the grain has no place in the mesh and goes to a boundary cell

    void add(const unsigned int c, const double s)
    {
      cell.push_back(c);
      share.push_back(s);
    }
    void scale_row(const double factor) // scales the row that end_row() has not yet closed
    {
      for (std::size_t k = begin.back(); k < share.size(); ++k)
        share[k] *= factor;
    }
    void end_row(const bool is_outside)
    {
      begin.push_back(cell.size());
      outside.push_back(is_outside);
    }
  };

  struct JoinedGrains
  {
    std::vector<double> sum, squares; // n_cells

    explicit JoinedGrains(const std::size_t n_cells)
        : sum(n_cells, 0.),
          squares(n_cells, 0.)
    {}
    void add(const unsigned int cell, const double share)
    {
      sum[cell] += share;
      squares[cell] += share * share;
    }

    std::vector<double> numbers() const
    {
      std::vector<double> n;
      for (std::size_t k = 0; k < sum.size(); ++k)
        n.push_back(squares[k] > 0 ? sum[k] * sum[k] / squares[k] : 0);
      return n;
    }
  };

  // CellSums::joined, or empty if it is not wanted. Several shares of one grain in one cell are added first.
  std::vector<double> joined_grains(const TargetCells &target, const Carriers &carriers, const GrainShares &shares);

  CellSums sums_by_owner(const TargetCells &target, const Carriers &carriers, const GrainShares &shares);
} // namespace diptych::coupling
