// diptych: a mesh of quadrilaterals as plain data, and what makes one sound
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "continuum/mesh.h"

namespace diptych::continuum
{
  constexpr std::array<BoundaryId, 5> all_boundary_ids{lower_platen, upper_platen, left_side, right_side, free_edge};

  // Name of the physical line of an id.
  const char *name_of(BoundaryId id);

  struct QuadMesh
  {
    struct Edge
    {
      std::array<unsigned int, 2> vertices;
      BoundaryId                  id;
    };

    std::vector<Eigen::Vector2d>             vertices; // [length]
    std::vector<std::array<unsigned int, 4>> cells;    // corners, counter-clockwise
    std::vector<Edge>                        boundary; // in any order and direction
  };

  // Throws std::runtime_error saying what is wrong and where: no cell; a clockwise, folded or flat cell; overlapping cells;
  // more than one piece (two cells that share a corner only are not connected); a vertex of no cell; a line inside the
  // mesh; an edge on two lines; a line missing (all but free_edge); a boundary edge on no line.
  void check(const QuadMesh &mesh);

  // Counts and measures of a sound mesh.
  MeshSummary summarise(const QuadMesh &mesh);

  // Least sine of a corner over all cells; not positive where one is clockwise, folded or a triangle in disguise.
  double worst_corner(const QuadMesh &mesh);
} // namespace diptych::continuum
