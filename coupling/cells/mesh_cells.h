// diptych: the cells that receive grain quantities, and their triangles
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "continuum/snapshot.h"

namespace diptych::coupling
{
  // The corners are counter-clockwise.
  struct CellTriangle
  {
    std::array<unsigned int, 3> node;
    unsigned int                cell;
  };

  // Quadrilaterals with straight edges and counter-clockwise corners, divided into triangles. A cell without hanging nodes has
  // the triangles 0-1-2 and 0-2-3. A cell beside smaller ones is a polygon with more triangles. Its neighbours' corners on its
  // edges are its hanging nodes. Neighbouring triangles therefore always share whole edges.
  struct QuadMesh
  {
    std::vector<Eigen::Vector2d>             node; // [length]
    std::vector<std::array<unsigned int, 4>> cell;
    std::vector<CellTriangle>                triangle; // sorted by cell
  };

  // Fills mesh.triangle. A node hangs on a cell's edge if it lies between its ends (initial shape, within 1e-9 of the length)
  // and no other cell has the whole edge. `initial` holds one place per node, in a shape in which the edges of divided cells
  // are straight. Without it the current places are used. A polygon is divided so that its flattest triangle is as round as
  // possible. If a cell of four nodes is not convex and its diagonal 0-2 lies outside, its corners are rotated by one. Throws
  // std::runtime_error with the cell's number if the cell cannot be divided into triangles of positive area.
  void triangulate(QuadMesh &mesh);
  void triangulate(QuadMesh &mesh, const std::vector<Eigen::Vector2d> &initial);

  // Cells of a continuum snapshot in the same order, with their triangles. The mesh keeps only the corners and numbers them by
  // first appearance. A node in the middle of an edge is kept where smaller cells meet there. Throws as triangulate() does.
  QuadMesh quad_mesh(const continuum::Snapshot &snapshot);

  // Divides a box into equal rectangles, numbered row by row from below. Their sides are as close to `size` as whole numbers of
  // rectangles allow. Throws std::invalid_argument for an empty box, a size that is not positive, or more than 1e8 cells.
  QuadMesh regular_grid(const Eigen::Vector2d &lower, const Eigen::Vector2d &upper, double size);

  std::array<unsigned int, 3>  triangle_nodes(const QuadMesh &mesh, unsigned int triangle);
  double                       triangle_area(const QuadMesh &mesh, unsigned int triangle);
  Eigen::Vector2d              cell_centre(const QuadMesh &mesh, unsigned int cell); // mean of the four corners
  std::vector<Eigen::Vector2d> cell_centres(const QuadMesh &mesh);                   // n_cells entries

  // Areas of the polygons, n_cells entries [length^2].
  std::vector<double> cell_areas(const QuadMesh &mesh);

  // Nodes of each cell's polygon with its hanging nodes, counter-clockwise from corner 0.
  std::vector<std::vector<unsigned int>> cell_outlines(const QuadMesh &mesh);

  // An edge of one triangle only. The mesh lies on its left.
  struct BoundaryEdge
  {
    unsigned int from, to, triangle; // two nodes, and the triangle that has this edge
  };
  std::vector<BoundaryEdge> boundary_edges(const QuadMesh &mesh); // sorted by triangle

  // Values of a triangle's linear shape functions at a point. They add up to 1, also outside the triangle.
  Eigen::Vector3d shape_values(const QuadMesh &mesh, unsigned int triangle, const Eigen::Vector2d &point);

  // Gradients of a triangle's three linear shape functions, one column each [1/length].
  Eigen::Matrix<double, 2, 3> shape_gradients(const QuadMesh &mesh, unsigned int triangle);
} // namespace diptych::coupling
