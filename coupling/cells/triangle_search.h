// diptych: finds the triangle that holds a point, and the triangles that a segment crosses
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "coupling/cells/bin_grid.h"
#include "coupling/cells/mesh_cells.h"

namespace diptych::coupling
{
  // Finds triangles with a uniform grid of bins. A point on an edge belongs to the triangle of lowest number (tolerance 1e-12
  // times the edge's length). A point outside the mesh belongs to the triangle at the nearest boundary edge.
  class TriangleSearch
  {
  public:
    struct Place
    {
      unsigned int triangle;
      bool         inside;
    };

    // A part of a segment a-b, with the parameters 0 <= from < to <= 1.
    struct Piece
    {
      unsigned int triangle;
      double       from, to;
      bool         inside;
    };

    // Throws std::invalid_argument for a mesh without triangles or a triangle without positive area.
    explicit TriangleSearch(const QuadMesh &mesh);

    Place locate(const Eigen::Vector2d &point) const;

    // Cuts a-b where it enters or leaves a triangle. Each piece begins where the previous one ends; the first begins at 0 and the
    // last ends at 1. The pieces therefore add up to the segment, whatever the rounding errors of the cuts.
    void cut(const Eigen::Vector2d &a, const Eigen::Vector2d &b, std::vector<Piece> &pieces) const;

    // Triangles whose bounding box meets the given box, ascending, each once.
    void triangles_in_box(const Eigen::Vector2d &lower, const Eigen::Vector2d &upper, std::vector<unsigned int> &triangles) const;

    // The numbers of the points, sorted bin by bin, so that points close in space are close in the list.
    std::vector<unsigned int> in_spatial_order(const std::vector<Eigen::Vector2d> &points) const;

    const std::array<Eigen::Vector2d, 3> &corners(const unsigned int triangle) const { return triangles[triangle].corner; }

  private:
    struct Triangle
    {
      std::array<Eigen::Vector2d, 3> corner;
      Eigen::Vector2d                lower, upper;
    };

    unsigned int nearest_boundary_triangle(const Eigen::Vector2d &point) const;

    std::vector<Triangle>                       triangles;
    std::vector<BoundaryEdge>                   boundary;
    std::vector<std::array<Eigen::Vector2d, 2>> boundary_ends;

    BinGrid bins; // of the triangles
  };
} // namespace diptych::coupling
