// diptych: both panels at the same instants, seen through the same operators
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "coupling/band.h"
#include "coupling/homogenisation/cell_cover.h"
#include "coupling/history_table.h"
#include "coupling/mesh_cells.h"
#include "coupling/probes.h"
#include "coupling/scene.h"
#include "coupling/strips.h"

namespace diptych::coupling
{
  // Displacement increments of one panel between two stages.
  struct PanelIncrement
  {
    DisplacementField   field;
    BandReport          band;
    Strips              strips;
    std::vector<double> cell_shear; // shear strain increment at the cell centres of the continuum's mesh, n_cells
  };

  struct Increment
  {
    double              from = 0, to = 0; // axial strain
    SampleFrame         frame;
    QuadMesh            mesh;  // of the continuum at `to`
    CellCover           cover; // by the grains at `to`
    PanelIncrement      discrete, continuum;
    std::vector<double> grain_shear; // shear strain increment at the grains
  };

  struct ProbeRecord
  {
    ProbeRegion region;
    ProbeStress stress;
    ProbeFabric fabric; // grains only
  };

  struct PanelRecord
  {
    double                       stress_ratio = 0, volumetric_strain = 0; // the former averaged over the last averaging_strain
    Eigen::Vector2d              lower_force, upper_force;                // on the sample, averaged likewise [pressure * length]
    double                       dynamic_share = 0;                       // grains: spin term / mean stress, over the stage
    std::vector<Eigen::Matrix2d> cell_stress;                             // on the continuum's mesh [pressure]
    std::vector<ProbeRecord>     probes;
  };

  struct StageRecord
  {
    double      axial_strain = 0;
    Increment   increment; // since the preceding stage
    PanelRecord discrete, continuum;
    double      total_relative_error = 0, outside_share = 0, nodal_residual = 0; // of the mapping
    double      stress_difference = 0;                                           // relative L2 over the covered cells
  };

  struct CoarseRun
  {
    double                 element_size = 0; // mean diameters
    std::vector<Increment> windows;          // continuum side only
    Peak                   peak;
  };

  // Everything the report shows. Lengths in the scene's own unit.
  struct Comparison
  {
    std::vector<StageRecord>         stages;
    std::vector<Increment>           windows;
    CoarseRun                        coarse;
    HistoryTable                     discrete_history, continuum_history;
    std::vector<discrete::Snapshot>  grains; // stage 0 first
    std::vector<continuum::Snapshot> nodes;
  };

  // From the files of a result folder, so that a comparison can be made again without any solver: discrete.h5/.csv,
  // continuum.h5/.csv, coarse/continuum.h5/.csv. Stages that only one panel reached are left out.
  // Throws std::runtime_error naming what is missing.
  Comparison compare(const Scene &scene, const std::string &directory);
} // namespace diptych::coupling
