// diptych: the results of the comparison at one stage
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "coupling/comparison/band_difference.h"
#include "coupling/probes/band_traction.h"
#include "coupling/fields/cell_fields.h"
#include "coupling/probes/circular_probe.h"
#include "coupling/probes/dissipation_split.h"
#include "coupling/probes/force_chains.h"
#include "coupling/comparison/increment.h"
#include "coupling/statistics/interval.h"
#include "coupling/probes/probe_statistics.h"
#include "coupling/probes/probes.h"
#include "coupling/scene/scene.h"
#include "coupling/fields/stress_difference.h"

namespace diptych::coupling
{
  struct ProbeRecord
  {
    ProbeRegion region;
    ProbeStress stress;
    // Only for grains.
    ProbeFabric    fabric;
    ProbeIntervals intervals;
    GrainPressure  pressure;
  };

  struct PanelRecord
  {
    Interval        stress_ratio; // mean over the last averaging_strain; for grains with the interval of batch means
    double          volumetric_strain = 0;
    Eigen::Vector2d lower_force, upper_force;  // forces on the sample, averaged in the same way [pressure * length]
    double          dynamic_share       = 0;   // grains: spin term / mean stress, over the stage
    double          acceleration_share  = NAN; // grains: acceleration term / mean stress, in the last step
    double          minor_direction_deg = NAN; // direction of the smallest compression of the mean stress over the stage, in
                                               // (-90, 90]
    std::vector<ProbeRecord>        probes;
    CircularProbe                   circle;
    std::optional<DissipationSplit> dissipation; // inside and outside the grains' band; empty if the grains have no band
    std::optional<BandTraction>     traction;    // along the grains' band; empty if the grains have no band
  };

  struct MappingRecord
  {
    std::string method; // averaging method
    double      total_relative_error = 0, outside_share = 0;
    double      window_time = 0; // time over which the grains' forces are averaged: impulses / this time
    // Residuals of `segments` on the mesh, of forces and of moments; NaN for other methods, and in the cases named in periodic.h.
    double nodal_residual = NAN, couple_residual = NAN;
  };

  struct StageRecord
  {
    double      progress = 0, axial_strain = 0, shear_strain = 0, time = 0; // of the grains' loading
    Increment   increment;                                                  // since the preceding stage
    PanelRecord discrete, continuum;

    std::vector<ProbeDifference> probe_differences; // differences between probes of the grains
    std::optional<ForceChains>   force_chains;      // of single grains, inside and outside the grains' band

    CellFields                    fields; // on the continuum's mesh
    CellFields                    grid;   // on the regular grid
    MappingRecord                 mapping;
    std::vector<StressDifference> stress_differences; // for cells, 3 d, 6 d
    std::string                   stress_verdict;

    Interval   stress_ratio_difference;            // continuum minus grains
    double     volumetric_strain_difference = NAN; // continuum minus grains
    BandValues band_difference;
  };

  // increment: the stage's increment; seed: of the bootstrap. The caller adds histories and the intervals of the stress ratio.
  StageRecord stage_record(Increment increment, const StagePair &stage, const ComparisonOptions &options, std::uint64_t seed);
} // namespace diptych::coupling
