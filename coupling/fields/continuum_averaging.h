// diptych: the continuum's fields seen through the averaging that the grains went through
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/fields/continuum_fields.h"
#include "coupling/averaging/averaging.h"
#include "coupling/cells/mesh_cells.h"

namespace diptych::coupling
{
  struct OwnFields
  {
    const QuadMesh        &mesh;
    const ContinuumFields &fields; // constant on its cells
  };

  struct SampleScale
  {
    double mean_diameter = 1; // [length]
    double period        = 0; // of a periodic sample [length], else 0
  };

  // A difference of the panels means something only where both went through the same cells or kernel. kernel, projection: the
  // continuum's densities (stress, couple stress, dissipation) times area are carriers like the grains' own, displacement and
  // rotation means weighted by area. The other methods only cut: means by the area that the cells share, NaN in
  // receiving cells of which less than half lies in the mesh.
  ContinuumFields averaged_continuum(const OwnFields        &own,
                                     const QuadMesh         &receiving,
                                     const SampleScale      &scale,
                                     const AveragingOptions &averaging);
} // namespace diptych::coupling
