// diptych: the fields of both panels on one set of cells
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
  // Both panels at the beginning and at the end of a stage.
  struct StagePair
  {
    const discrete::Snapshot  &grains_from, &grains_to;
    const continuum::Snapshot &nodes_from, &nodes_to;
  };

  // Each vector has n_cells entries, NaN where a panel has no value.
  struct CellFields
  {
    QuadMesh                     mesh;
    GrainFields                  grains;
    ContinuumFields              own;                // the continuum's fields on these cells, without averaging
    ContinuumFields              continuum;          // the continuum's fields after the same averaging as the grains
    std::vector<Eigen::Matrix2d> continuum_gradient; // gradient of the displacement increment, see GrainFields
    std::vector<double>          continuum_shear;    // eps_1 - eps_2 of the displacement increment, computed as for the grains
    std::vector<double>          continuum_spin;     // half the curl of the same increment, anticlockwise [radians]
    std::vector<double> continuum_relative; // relative rotation as of the grains [radians]; NaN if the law has no rotation
  };

  // Strain increments -sym(gradient), positive in compression.
  std::vector<Eigen::Matrix2d> strain_increments(const std::vector<Eigen::Matrix2d> &displacement_gradient);

  // Fields on the continuum's mesh, in its shape at the end of the stage.
  CellFields mesh_fields(const QuadMesh &mesh, const StagePair &stage, const AveragingOptions &averaging);

  // Fields on a regular grid over the mesh with cells of about `size` [length].
  CellFields grid_fields(const CellFields &on_mesh, const StagePair &stage, const AveragingOptions &averaging, double size);

  // Stresses at three resolutions: the mesh's cells, and grids of 3 and 6 mean diameters. On the grids only cells count that lie
  // in the mesh to at least nine tenths.
  std::vector<StressDifference> stress_differences(const CellFields       &on_mesh,
                                                   const StagePair        &stage,
                                                   const AveragingOptions &averaging);
} // namespace diptych::coupling
