// diptych: displacement increments of both panels between two instants, seen through the same operators
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "continuum/snapshot.h"
#include "coupling/bands/band_detection.h"
#include "coupling/fields/cell_fields.h"
#include "coupling/averaging/cell_cover.h"
#include "coupling/cells/mesh_cells.h"
#include "coupling/bands/strips.h"
#include "discrete/snapshot.h"

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
    double from = 0, to = 0; // progress
    double duration = 0;     // of the grains' loading in between [time]
    // What displacements count in: the upper platen's increment, or, where it rests, the 98th percentile of the grains' [length].
    double              displacement_unit = 0;
    SampleFrame         frame;
    QuadMesh            mesh;  // of the continuum at `to`
    CellCover           cover; // by the grains at `to`
    PanelIncrement      discrete, continuum;
    std::vector<double> grain_shear; // shear strain increment at the grains
  };

  // Box of the sample at `to`, by the outline of its grains, and how far the upper platen went.
  SampleFrame sample_frame(const discrete::Snapshot &from, const discrete::Snapshot &to);

  // seed: of the resamples that give the bands' intervals.
  Increment make_increment(const StagePair &pair, const BandOptions &options, std::uint64_t seed);

  // The continuum alone, in the frame of another increment.
  PanelIncrement continuum_increment(const continuum::Snapshot &from,
                                     const continuum::Snapshot &to,
                                     const SampleFrame         &frame,
                                     const BandOptions         &options,
                                     std::uint64_t              seed);
} // namespace diptych::coupling
