// diptych: a mesh of quadrilaterals as plain data, and its checks
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace diptych::continuum
{
  // Ids of the lines that bound every mesh of the continuum panel. In mesh files they are the numbers of physical lines. The
  // lines have the names of the enumerators; free_edge is called "free". A mesh may lack only that one.
  enum BoundaryId : unsigned int
  {
    lower_platen = 1,
    upper_platen = 2,
    left_side    = 3,
    right_side   = 4,
    free_edge    = 5 // neither platen nor side: no force, no prescribed motion
  };

  constexpr std::array<BoundaryId, 5> all_boundary_ids{lower_platen, upper_platen, left_side, right_side, free_edge};

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

  // Order of the corners of a quadrilateral. `folded` includes concave and flat ones.
  enum class Turn
  {
    counter_clockwise,
    clockwise,
    folded
  };
  Turn turn_of(const std::array<Eigen::Vector2d, 4> &corners);

  // Throws std::invalid_argument with fault and place. Cells: none, clockwise, folded, flat or overlapping; more than one piece
  // (a common corner does not connect); a vertex without a cell. Lines: inside the mesh, missing (except free_edge); an edge on
  // two lines; a boundary edge without a line.
  void check(const QuadMesh &mesh);

  struct MeshSummary
  {
    unsigned int n_cells       = 0;
    unsigned int n_vertices    = 0;
    double       area          = 0;     // [length^2]
    double       shortest_edge = 0;     // [length]
    double       longest_edge  = 0;     // [length]
    double       height        = 0;     // [length]
    double       platen_width  = 0;     // of the upper one [length]
    bool         sides_match   = false; // both sides carry vertices at equal heights (within 1e-9 of the mesh's height)
  };

  MeshSummary summarise(const QuadMesh &mesh);

  // Least sine of a corner over all cells; not positive if a cell is clockwise, folded or flat.
  double worst_corner(const QuadMesh &mesh);
} // namespace diptych::continuum
