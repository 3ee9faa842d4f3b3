// diptych: how sure the probes are: intervals, dispersion of single grains, differences between zone and packs
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "coupling/statistics/block_bootstrap.h"
#include "coupling/probes/grain_network.h"
#include "coupling/statistics/interval.h"
#include "coupling/probes/probe_regions.h"

namespace diptych::coupling
{
  // Sums over what a block of a probe holds: grains by their centre, contacts (those that bear force) by their point.
  struct ProbeBlock
  {
    Eigen::Matrix2d moment    = Eigen::Matrix2d::Zero(); // [pressure * length^2]
    double          disc_area = 0;                       // [length^2]
    Eigen::Matrix2d normals   = Eigen::Matrix2d::Zero(); // sum of n (x) n
    int             contacts  = 0;
    Eigen::Vector2i place     = Eigen::Vector2i::Zero(); // column and row in the probe
  };

  struct ProbeBlocks
  {
    std::vector<ProbeBlock> block;              // those that hold a grain or a contact
    double                  solid_fraction = 0; // of the probe, exact
  };

  // What one state of the blocks tells; the definitions of ProbeStress and ProbeFabric.
  struct ProbeNumbers
  {
    double s1 = NAN, s2 = NAN, t_over_s = NAN, direction_deg = NAN; // of the stress
    double anisotropy = NAN, fabric_direction_deg = NAN;
    double fabric_to_stress_deg = NAN; // fabric's major direction, anticlockwise from the stress's, in (-90, 90]
  };

  // 95 % each. Directions are unwrapped around the value; +-90 degrees is all there can be.
  struct ProbeIntervals
  {
    Interval s1, s2, t_over_s, direction_deg, anisotropy, fabric_direction_deg, fabric_to_stress_deg;
    int      blocks = 0;
  };

  // Pressure of single grains: trace of the moment / 2 / disc area, so that its mean by area times the solid fraction is s. Each
  // grain counts once, rattlers too. Percentiles by linear interpolation.
  struct GrainPressure
  {
    double                mean = NAN, deviation = NAN;               // [pressure]
    std::array<double, 5> percentiles = {{NAN, NAN, NAN, NAN, NAN}}; // at percentile_levels [pressure]
    int                   grains      = 0;
  };
  constexpr std::array<int, 5> percentile_levels = {{5, 25, 50, 75, 95}};

  // Differences below these count as none.
  struct ProbeMargins
  {
    double t_over_s      = 0.05;
    double anisotropy    = 0.1;
    double direction_deg = 10;
  };

  // first - second, each with its 95 % interval.
  struct ProbeDifference
  {
    std::string first, second;
    Interval    t_over_s, anisotropy, direction_deg; // direction of the stress
    std::string verdict;
  };

  // The probe cut into blocks of at least `block` [length] along its sides. Empty probe: no blocks.
  ProbeBlocks probe_blocks(const ProbeRegion &probe, const GrainNetwork &network, double block);

  // Each block counted as often as `times` says (n_blocks entries).
  ProbeNumbers probe_numbers(const ProbeBlocks &blocks, const std::vector<int> &times);

  ProbeIntervals probe_intervals(const ProbeBlocks &blocks, const BootstrapOptions &options);

  GrainPressure grain_pressure(const ProbeRegion &probe, const GrainNetwork &network);

  // The probe of the zone (where there is none: the first) minus each of the others. The verdict says of each quantity
  // "differs" (the interval leaves out 0), "does not differ" (it lies within the margin on both sides) or "cannot tell"; its
  // first words are "differ" if one of them does, "do not differ" if none does, else "cannot tell". Probes are resampled each by
  // itself.
  std::vector<ProbeDifference> probe_differences(const std::vector<ProbeRegion> &probes,
                                                 const std::vector<ProbeBlocks> &blocks,
                                                 const BootstrapOptions         &options,
                                                 const ProbeMargins             &margins = {});
} // namespace diptych::coupling
