// diptych: every field of both panels on one set of cells
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "continuum/snapshot.h"
#include "coupling/fields/continuum_fields.h"
#include "coupling/fields/fields.h"
#include "coupling/cells/mesh_cells.h"
#include "coupling/fields/stress_difference.h"
#include "discrete/snapshot.h"

namespace diptych::coupling
{
  // What one stage is made of: both panels at its beginning and its end.
  struct StagePair
  {
    const discrete::Snapshot  &grains_from, &grains_to;
    const continuum::Snapshot &nodes_from, &nodes_to;
  };

  // n_cells entries each, NaN where a panel has no value.
  struct CellFields
  {
    QuadMesh                     mesh;
    GrainFields                  grains;
    ContinuumFields              own;                // the continuum's, as it is on these cells
    ContinuumFields              continuum;          // through the same averaging as the grains
    std::vector<Eigen::Matrix2d> continuum_gradient; // of the displacement increment, as GrainFields has it
    std::vector<double>          continuum_shear;    // eps_1 - eps_2 of the displacement increment, by the grains' operator
    std::vector<double>          continuum_spin;     // half the curl of the same increment, anticlockwise [radians]
  };

  // Strain increments -sym(gradient), positive in compression.
  std::vector<Eigen::Matrix2d> strain_increments(const std::vector<Eigen::Matrix2d> &displacement_gradient);

  // On the continuum's own mesh in its shape at the end of the stage.
  CellFields mesh_fields(const QuadMesh &mesh, const StagePair &stage, const AveragingOptions &averaging);

  // On a regular grid over the mesh, its cells about `size` [length].
  CellFields grid_fields(const CellFields &on_mesh, const StagePair &stage, const AveragingOptions &averaging, double size);

  // Stresses at three resolutions: the mesh's own cells, and grids of 3 and 6 mean diameters, of which only cells that lie in
  // the mesh to at least nine tenths count.
  std::vector<StressDifference> stress_differences(const CellFields       &on_mesh,
                                                   const StagePair        &stage,
                                                   const AveragingOptions &averaging);
} // namespace diptych::coupling
