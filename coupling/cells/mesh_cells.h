// diptych: the cells that grain quantities are mapped onto, and the triangles they are made of
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "continuum/snapshot.h"

namespace diptych::coupling
{
  // Corners counter-clockwise.
  struct CellTriangle
  {
    std::array<unsigned int, 3> node;
    unsigned int                cell;
  };

  // Quadrilaterals with straight edges, corners counter-clockwise, and the triangles they are divided into: of a cell without
  // hanging nodes the corners 0-1-2, then 0-2-3. A cell beside smaller ones is a polygon through its neighbours' corners
  // on its edges (hanging nodes) and has more triangles; every edge of a triangle is then an edge of its neighbour's, too.
  struct QuadMesh
  {
    std::vector<Eigen::Vector2d>             node; // [length]
    std::vector<std::array<unsigned int, 4>> cell;
    std::vector<CellTriangle>                triangle; // those of a cell follow one another, cells ascending
  };

  // Fills mesh.triangle. A node hangs on an edge of a cell where, in the shape `initial` (n_nodes places, in which edges of
  // divided cells are straight; without it: as it is), it lies between the edge's ends within 1e-9 of its length and no
  // cell shares the whole edge. Of all divisions of a polygon into triangles the one whose flattest triangle is least flat.
  // A cell of four nodes that is concave at the end of its diagonal 0-2 has its corners rotated by one. Throws
  // std::runtime_error naming the cell that cannot be divided into triangles of positive area.
  void triangulate(QuadMesh &mesh);
  void triangulate(QuadMesh &mesh, const std::vector<Eigen::Vector2d> &initial);

  // Current corners of the continuum's cells, same cell order, with their triangles. Only corners are kept and numbered
  // anew by first appearance; the middle of an edge counts where smaller cells meet there. Throws as triangulate().
  QuadMesh quad_mesh(const continuum::Snapshot &snapshot);

  // Equal rectangles over a box, their sides as near to `size` as whole numbers of them allow; row by row from below. Throws
  // std::invalid_argument for an empty box, a size that is not positive, or more than 1e8 cells.
  QuadMesh regular_grid(const Eigen::Vector2d &lower, const Eigen::Vector2d &upper, double size);

  std::array<unsigned int, 3>  triangle_nodes(const QuadMesh &mesh, unsigned int triangle);
  double                       triangle_area(const QuadMesh &mesh, unsigned int triangle);
  Eigen::Vector2d              cell_centre(const QuadMesh &mesh, unsigned int cell); // mean of the four corners
  std::vector<Eigen::Vector2d> cell_centres(const QuadMesh &mesh);                   // n_cells entries

  // n_cells entries [length^2]: of the polygons.
  std::vector<double> cell_areas(const QuadMesh &mesh);

  // Nodes of every cell's polygon, counter-clockwise from its corner 0; hanging nodes included.
  std::vector<std::vector<unsigned int>> cell_outlines(const QuadMesh &mesh);

  // An edge that only one triangle has, the mesh to its left.
  struct BoundaryEdge
  {
    unsigned int from, to, triangle; // nodes; the triangle that has it
  };
  std::vector<BoundaryEdge> boundary_edges(const QuadMesh &mesh); // triangles ascending

  // Linear shape functions of a triangle at a point; they add up to 1, also outside it.
  Eigen::Vector3d shape_values(const QuadMesh &mesh, unsigned int triangle, const Eigen::Vector2d &point);

  // Gradients of the three linear shape functions of a triangle, one a column [1/length].
  Eigen::Matrix<double, 2, 3> shape_gradients(const QuadMesh &mesh, unsigned int triangle);
} // namespace diptych::coupling
