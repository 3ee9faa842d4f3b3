// diptych: grains of one stage mapped onto cells, across the edge of a periodic sample, too
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/averaging/cell_cover.h"
#include "coupling/averaging/segments.h"
#include "discrete/snapshot.h"

namespace diptych::coupling
{
  // The mesh three times: itself, then its images one period to the left and to the right. Triangle t of image k has the
  // number k * n_triangles + t; the images share no nodes.
  QuadMesh tiled(const QuadMesh &mesh, double period);

  // Window forces and spin terms of a stage on the cells. A branch of a periodic sample that leaves the mesh comes in again on
  // the other side. What lies outside the mesh is mapped onto a collar round it (collar.h), whose triangles belong to the
  // cells at the boundary.
  struct MappedGrains
  {
    MappedMoment moment; // of the mesh's triangles, those of the collar and the spin term included
    // Nodal identity (segments.h) of the window forces, collar included, boundary and sides of a periodic mesh as well: largest
    // difference at any node / largest contact force. NaN without a collar, or without forces.
    double nodal_residual = 0;
    // false: no collar (the boundary is not star-shaped, or a periodic mesh's sides are not one period apart), or a
    // branch beyond it. What lies outside then belongs to the nearest boundary cell: totals hold, the nodal identity cannot.
    bool has_collar = false;
  };
  MappedGrains map_grains(const QuadMesh &mesh, const discrete::Snapshot &grains);

  // The nodal identity of the last step (`contacts`) with the applied forces, nodal_applied_forces() in the place of sums of
  // contact forces: it holds by the grains' balance of momentum. acceleration: in that step [length/time^2]. NaN as above.
  double momentum_residual(const QuadMesh                     &mesh,
                           const discrete::Snapshot           &grains,
                           const std::vector<Eigen::Vector2d> &acceleration);

  CellCover grain_cover(const QuadMesh &mesh, const discrete::Snapshot &grains);
} // namespace diptych::coupling
