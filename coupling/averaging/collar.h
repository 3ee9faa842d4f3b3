// diptych: a ring of triangles round a mesh, so that linear shape functions go on where branches leave it
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "coupling/cells/mesh_cells.h"

namespace diptych::coupling
{
  // A mesh with the triangles round it. Its nodes and triangles keep their numbers; the collar's come after them. Of a periodic
  // mesh there are three images, itself and those one period to the left and to the right.
  struct CollaredMesh
  {
    QuadMesh                  mesh;     // `cell` of every triangle: of the given mesh
    std::vector<unsigned int> receiver; // n_triangles: the given mesh's triangle that takes over its moment: itself, or the one
                                        // at the boundary edge that the collar's triangle begins at
    std::vector<unsigned int> same_as;  // n_nodes: the node whose image it is; itself where it is none
    std::size_t               n_inner = 0; // triangles from here on belong to the collar
  };

  // Every boundary edge joined to its image scaled away from the middle of the mesh by so much that all of `points` lie inside,
  // two triangles each. None where the boundary is not star-shaped: where no place sees every boundary edge from inside.
  std::optional<CollaredMesh> with_collar(const QuadMesh &mesh, const std::vector<Eigen::Vector2d> &points);

  // The edges of lower and upper boundary joined to their images below and above; the nodes of left and right side, one period
  // apart within 1e-6 of it, are the same ones. None where the sides do not match so, or lower and upper boundary are no
  // functions of x. points: as grains keep them, whole periods left or right of the mesh allowed.
  std::optional<CollaredMesh> with_periodic_collar(const QuadMesh                     &mesh,
                                                   double                              period,
                                                   const std::vector<Eigen::Vector2d> &points);

  // The mesh alone, or (period > 0) its three images, which share no nodes: for meshes that can have no collar.
  CollaredMesh without_collar(const QuadMesh &mesh, double period);

  // Largest difference of two sums over nodes at any node, images of one node taken together.
  double largest_difference(const CollaredMesh                 &cells,
                            const std::vector<Eigen::Vector2d> &a,
                            const std::vector<Eigen::Vector2d> &b);
} // namespace diptych::coupling
