// diptych: maps the grains of one stage onto cells, also in periodic samples
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/averaging/cell_cover.h"
#include "coupling/averaging/segments.h"
#include "coupling/cells/period.h"
#include "discrete/snapshot.h"

namespace diptych::coupling
{
  // Contact forces over the window of a stage, and spin terms, mapped onto the cells. In a periodic sample a branch that leaves
  // the mesh enters again on the opposite side. Boundary cells own the parts on a collar (collar.h) outside the mesh.
  struct MappedGrains
  {
    MappedMoment moment; // moment of each triangle of the mesh, with the collar's share and the spin term
    // Residual of the nodal identity (segments.h) for the window forces: largest difference at any node / largest contact force.
    // It covers the nodes of the collar, the boundary and the periodic sides. NaN without a collar or without forces.
    double nodal_residual = 0;
    // False if the mesh can have no collar (collar.h) and does not fill a cell that is periodic in both directions, or a branch
    // reaches beyond it. Parts outside then belong to the nearest boundary cell, and only the totals are exact.
    bool has_collar = false;
  };
  MappedGrains map_grains(const QuadMesh &mesh, const discrete::Snapshot &grains);

  // Residual of the nodal identity for the last step (`contacts`), with nodal_applied_forces() in place of the sums of contact
  // forces. It vanishes by the grains' balance of momentum. `acceleration`: in the last step [length/time^2]. NaN as in
  // MappedGrains.
  double momentum_residual(const QuadMesh                     &mesh,
                           const discrete::Snapshot           &grains,
                           const std::vector<Eigen::Vector2d> &acceleration);

  CellCover grain_cover(const QuadMesh &mesh, const discrete::Snapshot &grains);
  CellCover grain_cover(const QuadMesh              &mesh,
                        const Period                &period,
                        std::vector<Eigen::Vector2d> position,
                        std::vector<double>          radius);
} // namespace diptych::coupling
