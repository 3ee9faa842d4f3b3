// diptych: displacement increments of both panels between two instants, and their bands and strips
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "continuum/snapshot.h"
#include "coupling/bands/band_detection.h"
#include "coupling/bands/band_profile.h"
#include "coupling/fields/cell_fields.h"
#include "coupling/averaging/cell_cover.h"
#include "coupling/cells/mesh_cells.h"
#include "coupling/bands/strips.h"
#include "discrete/snapshot.h"

namespace diptych::coupling
{
  struct PanelIncrement
  {
    DisplacementField   field;
    BandReport          band;
    Strips              strips;
    std::vector<double> cell_shear; // n_cells shear strain increments at the cell centres of the continuum's mesh

    std::optional<BandProfile> profile; // increment_profiles.h; empty if no panel has a band
  };

  struct Increment
  {
    double from = 0, to = 0; // progress
    double duration = 0;     // time of the grains' loading from the first to the second instant [time]
    // Unit of displacements: the upper platen's increment, or the 98th percentile of the grains' if the platen rests [length].
    double              displacement_unit   = 0;
    bool                is_mirror_symmetric = false; // is_mirror_symmetric() of the scene
    SampleFrame         frame;
    QuadMesh            mesh;  // the continuum's mesh at `to`
    CellCover           cover; // cover of the cells by the grains at `to`
    PanelIncrement      discrete, continuum;
    std::vector<double> grain_shear; // shear strain increments at the grains
  };

  // The sample's box at `to`, from the outline of its grains, and the displacement of the upper platen.
  SampleFrame sample_frame(const discrete::Snapshot &from, const discrete::Snapshot &to);

  // seed: draws the resamples for the intervals of the bands.
  Increment make_increment(const StagePair &pair, const BandOptions &options, std::uint64_t seed);

  // The continuum only, in the frame of another increment.
  PanelIncrement continuum_increment(const continuum::Snapshot &from,
                                     const continuum::Snapshot &to,
                                     const SampleFrame         &frame,
                                     const BandOptions         &options,
                                     std::uint64_t              seed);
} // namespace diptych::coupling
