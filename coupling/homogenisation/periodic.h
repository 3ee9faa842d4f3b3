// diptych: grains of one stage mapped onto cells, across the edge of a periodic sample, too
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/homogenisation/cell_cover.h"
#include "coupling/homogenisation/segments.h"
#include "discrete/snapshot.h"

namespace diptych::coupling
{
  // The mesh three times: itself, then its images one period to the left and to the right. Triangle t of image k has the
  // number k * 2 n_cells + t; the images share no nodes.
  QuadMesh tiled(const QuadMesh &mesh, double period);

  // Window forces and spin terms of a stage on the cells. A branch of a periodic sample that leaves the mesh comes in again on
  // the other side.
  struct MappedGrains
  {
    MappedMoment moment; // the spin term included
    // Nodal identity (segments.h), relative. NaN where shape functions are not continuous: periodic, or with hanging nodes.
    double nodal_residual = 0;
  };
  MappedGrains map_grains(const QuadMesh &mesh, const discrete::Snapshot &grains);

  CellCover grain_cover(const QuadMesh &mesh, const discrete::Snapshot &grains);
} // namespace diptych::coupling
