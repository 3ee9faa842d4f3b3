// diptych: the cells that grain quantities are mapped onto: areas, point location, cutting of segments
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "continuum/snapshot.h"

namespace diptych::coupling
{
  // Quadrilaterals with straight edges, corners counter-clockwise. Each is two triangles: number 2*cell has the corners
  // 0-1-2, number 2*cell+1 the corners 0-2-3.
  struct QuadMesh
  {
    std::vector<Eigen::Vector2d>             node; // [length]
    std::vector<std::array<unsigned int, 4>> cell;
  };

  // Current corners of the continuum's cells, same cell order. Corners only are kept and numbered anew by first appearance. A
  // cell that is concave at the end of its diagonal 0-2 has its corners rotated by one. Throws std::runtime_error
  // naming the cell when neither diagonal gives two triangles of positive area.
  QuadMesh quad_mesh(const continuum::Snapshot &snapshot);

  std::array<unsigned int, 3> triangle_nodes(const QuadMesh &mesh, unsigned int triangle);
  double                      triangle_area(const QuadMesh &mesh, unsigned int triangle);
  Eigen::Vector2d             cell_centre(const QuadMesh &mesh, unsigned int cell); // mean of the corners

  // n_cells entries [length^2].
  std::vector<double> cell_areas(const QuadMesh &mesh);

  // Gradients of the three linear shape functions of a triangle, one a column [1/length].
  Eigen::Matrix<double, 2, 3> shape_gradients(const QuadMesh &mesh, unsigned int triangle);

  // Finds triangles through a uniform grid of bins. A point on an edge belongs to the triangle of lowest number (tolerance
  // 1e-12 of the edge); a point outside the mesh to the triangle at the nearest boundary edge.
  class TriangleSearch
  {
  public:
    struct Place
    {
      unsigned int triangle;
      bool         inside;
    };

    // A part of a segment a-b: parameters 0 <= from < to <= 1.
    struct Piece
    {
      unsigned int triangle;
      double       from, to;
      bool         inside;
    };

    // Throws std::invalid_argument for an empty mesh or a triangle without positive area.
    explicit TriangleSearch(const QuadMesh &mesh);

    Place locate(const Eigen::Vector2d &point) const;

    // Cuts a-b where it enters or leaves a triangle. The pieces are in order and each begins where the one before ends, the
    // first at 0 and the last at 1: their sum is the segment, whatever rounding does to the cuts.
    void cut(const Eigen::Vector2d &a, const Eigen::Vector2d &b, std::vector<Piece> &pieces) const;

    // Triangles whose bounding box meets the given box, ascending, each once.
    void triangles_in_box(const Eigen::Vector2d &lower, const Eigen::Vector2d &upper, std::vector<unsigned int> &triangles) const;

    const std::array<Eigen::Vector2d, 3> &corners(const unsigned int triangle) const { return triangles[triangle].corner; }

  private:
    struct Triangle
    {
      std::array<Eigen::Vector2d, 3> corner;
      Eigen::Vector2d                lower, upper;
    };

    struct BoundaryEdge
    {
      unsigned int    triangle;
      Eigen::Vector2d from, to;
    };

    struct BinRange
    {
      int column_begin, column_end, row_begin, row_end;
    };

    BinRange     bins(const Eigen::Vector2d &lower, const Eigen::Vector2d &upper) const;
    unsigned int nearest_boundary_triangle(const Eigen::Vector2d &point) const;

    std::vector<Triangle>     triangles;
    std::vector<BoundaryEdge> boundary;

    Eigen::Vector2d           origin;
    double                    bin_size  = 1;
    int                       n_columns = 1, n_rows = 1;
    std::vector<unsigned int> bin_begin, bin_triangle; // triangles of bin b: bin_triangle[bin_begin[b] .. bin_begin[b+1])
  };
} // namespace diptych::coupling
