// diptych: statistics of the probes: intervals, dispersion of single grains, differences between band and packs
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
  // Sums over one block of a probe. Grains count by their centre, and contacts that carry force by their point.
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
    std::vector<ProbeBlock> block;              // blocks that hold a grain or a contact
    double                  solid_fraction = 0; // exact solid fraction of the probe
  };

  // The numbers of a probe for one resample of its blocks, defined as in ProbeStress and ProbeFabric.
  struct ProbeNumbers
  {
    double s1 = NAN, s2 = NAN, t_over_s = NAN, direction_deg = NAN; // numbers of the stress
    double anisotropy = NAN, fabric_direction_deg = NAN;
    double fabric_to_stress_deg = NAN; // from the stress's major direction anticlockwise to the fabric's, in (-90, 90]
  };

  // 95 % intervals. Intervals of directions are unwrapped around the value and extend at most 90 degrees to either side.
  struct ProbeIntervals
  {
    Interval s1, s2, t_over_s, direction_deg, anisotropy, fabric_direction_deg, fabric_to_stress_deg;
    int      blocks = 0;
  };

  // Pressure of single grains: trace of the moment / 2 / disc area. Its mean weighted by area, times the solid fraction, is s.
  // Here each grain counts once, also rattlers. Percentiles are interpolated linearly.
  struct GrainPressure
  {
    double                mean = NAN, deviation = NAN;               // mean and standard deviation [pressure]
    std::array<double, 5> percentiles = {{NAN, NAN, NAN, NAN, NAN}}; // at percentile_levels [pressure]
    int                   grains      = 0;
  };
  constexpr std::array<int, 5> percentile_levels = {{5, 25, 50, 75, 95}};

  // A difference whose 95 % interval lies within its margin counts as none.
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
    Interval    t_over_s, anisotropy, direction_deg; // direction of the major principal stress
    std::string verdict;
  };

  // The probe cut along its sides into blocks of at least `block` [length]. An empty probe has no blocks.
  ProbeBlocks probe_blocks(const ProbeRegion &probe, const GrainNetwork &network, double block);

  // `times` says how often each block counts (n_blocks entries).
  ProbeNumbers probe_numbers(const ProbeBlocks &blocks, const std::vector<int> &times);

  ProbeIntervals probe_intervals(const ProbeBlocks &blocks, const BootstrapOptions &options);

  GrainPressure grain_pressure(const ProbeRegion &probe, const GrainNetwork &network);

  // The probe in the band (or the first probe) minus each of the others. Each probe is resampled separately. The verdict gives
  // one of these for each quantity, tested in this order:
  //   "differs" if the interval does not contain 0, even if it lies within the margin;
  //   "does not differ" if the interval lies within the margin;
  //   "cannot tell" otherwise.
  // It begins with "differ" if one quantity differs, "do not differ" if none does, else "cannot tell". This test is stricter than
  // Verdict (equivalence.h), where panels are different only beyond the margin.
  std::vector<ProbeDifference> probe_differences(const std::vector<ProbeRegion> &probes,
                                                 const std::vector<ProbeBlocks> &blocks,
                                                 const BootstrapOptions         &options,
                                                 const ProbeMargins             &margins = {});
} // namespace diptych::coupling
