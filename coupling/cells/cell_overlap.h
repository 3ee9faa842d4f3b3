// diptych: areas that the cells of two meshes share, and mean values transferred from one mesh to the other
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>

#include <Eigen/Core>

#include "coupling/cells/mesh_cells.h"

namespace diptych::coupling
{
  // Compressed rows, one row for each cell of the receiving mesh.
  struct CellOverlap
  {
    std::vector<std::size_t>  begin;    // n_cells + 1
    std::vector<unsigned int> cell;     // cell of the giving mesh, ascending in each row
    std::vector<double>       area;     // shared area [length^2]
    std::vector<double>       row_area; // area of the receiving cell [length^2]
  };

  // Computes the shared areas exactly: it clips the triangles of one mesh against those of the other.
  CellOverlap cell_overlap(const QuadMesh &receiving, const QuadMesh &giving);

  // Transfers values from the giving mesh to the receiving one. Each receiving cell gets the mean weighted by shared area. It
  // gets `missing` if less than half of it has finite values.
  template <class Value>
  std::vector<Value> carried_over(const CellOverlap &overlap, const std::vector<Value> &values, const Value &missing)
  {
    const auto finite = [](const Value &v) {
      if constexpr (std::is_arithmetic_v<Value>)
        return std::isfinite(v);
      else
        return v.allFinite();
    };
    std::vector<Value> means;
    for (std::size_t row = 0; row + 1 < overlap.begin.size(); ++row)
      {
        Value  sum{}; // Eigen does not initialise its own types
        double area = 0;
        if constexpr (!std::is_arithmetic_v<Value>)
          sum.setZero();
        for (std::size_t k = overlap.begin[row]; k < overlap.begin[row + 1]; ++k)
          if (finite(values[overlap.cell[k]]))
            {
              sum += overlap.area[k] * values[overlap.cell[k]];
              area += overlap.area[k];
            }
        means.push_back(area >= 0.5 * overlap.row_area[row] && area > 0 ? Value(sum / area) : missing);
      }
    return means;
  }
} // namespace diptych::coupling
