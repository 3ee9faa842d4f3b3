// diptych: the continuum's fields after the averaging that is applied to the grains
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/fields/continuum_fields.h"
#include "coupling/averaging/averaging.h"
#include "coupling/cells/cell_overlap.h"
#include "coupling/cells/mesh_cells.h"

namespace diptych::coupling
{
  struct OwnFields
  {
    const QuadMesh        &mesh;
    const ContinuumFields &fields; // constant on each cell of the mesh
  };

  struct SampleScale
  {
    double mean_diameter = 1; // [length]
    Period period        = {};
  };

  // A difference between the panels is meaningful only if both were averaged over the same cells or by the same kernel.
  //   kernel, projection: the continuum's densities (stress, couple stress, dissipation) times area are distributed like the
  //     grains' quantities. Displacement and rotation are means weighted by area.
  //   other methods: means weighted by the area that the cells share. NaN in receiving cells of which less than half lies in the
  //   mesh. `known`: their overlap with the mesh, if it is known.
  ContinuumFields averaged_continuum(const OwnFields        &own,
                                     const QuadMesh         &receiving,
                                     const SampleScale      &scale,
                                     const AveragingOptions &averaging,
                                     const CellOverlap      *known = nullptr);
} // namespace diptych::coupling
