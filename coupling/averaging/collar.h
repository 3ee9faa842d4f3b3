// diptych: a ring of triangles around a mesh, where linear shape functions continue for branches that leave the mesh
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "coupling/cells/mesh_cells.h"
#include "coupling/cells/period.h"

namespace diptych::coupling
{
  // A mesh with a collar, a ring of triangles around it. The mesh's nodes and triangles keep their numbers; the collar's follow.
  // For a periodic mesh there are images: the mesh itself and those one period away.
  struct CollaredMesh
  {
    QuadMesh                  mesh;          // `cell` of each triangle is a cell of the given mesh
    std::vector<unsigned int> receiver;      // n_triangles: the given mesh's triangle that receives its moment: itself, or for a
                                             // triangle of the collar the one at the boundary edge where it begins
    std::vector<unsigned int> same_as;       // n_nodes: the node whose periodic image it is, or itself
    std::size_t               n_inner   = 0; // triangles from this number on belong to the collar
    bool                      is_closed = false; // no branch can leave: a collar holds all, or the images fill the plane
  };

  // Joins every boundary edge by two triangles to its image. The image is scaled away from the middle of the mesh, far enough
  // that all `points` lie inside. Empty if the boundary is not star-shaped, that is, if no place inside sees every boundary edge.
  std::optional<CollaredMesh> with_collar(const QuadMesh &mesh, const std::vector<Eigen::Vector2d> &points);

  // Joins the edges of the lower and upper boundary to images below and above. Left and right nodes of equal height are one
  // unknown. Empty if the distance of the sides is not the period (to 1e-6), or a boundary is not a function of x. `points`: as
  // the grains store them, possibly whole periods left or right of the mesh.
  std::optional<CollaredMesh> with_periodic_collar(const QuadMesh                     &mesh,
                                                   double                              period,
                                                   const std::vector<Eigen::Vector2d> &points);

  // The mesh with the collar that suits its period. In a cell that is periodic in both directions there is no collar: opposite
  // sides share their nodes. If that is not possible (is_closed false), the mesh and its images, which share no nodes.
  CollaredMesh ground_of(const QuadMesh &mesh, const Period &period, const std::vector<Eigen::Vector2d> &points);

  // Largest difference at any node between two sums over nodes. The values of all images of a node are added first.
  double largest_difference(const CollaredMesh                 &cells,
                            const std::vector<Eigen::Vector2d> &a,
                            const std::vector<Eigen::Vector2d> &b);
} // namespace diptych::coupling
