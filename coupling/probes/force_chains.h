// diptych: do the force chains see the shear zone? Stress of single grains and contact forces inside against outside it
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "coupling/bands/band_zone.h"
#include "coupling/statistics/block_bootstrap.h"
#include "coupling/probes/grain_network.h"
#include "coupling/statistics/interval.h"

namespace diptych::coupling
{
  // Where the distributions have their values.
  constexpr std::array<double, 11> chain_quantiles = {{0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95}};

  // Values relative to the mean over inside and outside together.
  struct ChainDistribution
  {
    int                    count = 0;                          // grains or contacts
    double                 mean = NAN, share_above_mean = NAN; // of 1, the common mean
    std::array<double, 11> values = {};                        // at chain_quantiles
  };

  // largest_distance: D = largest difference of the two cumulative distributions (Kolmogorov and Smirnov), +- the 95 % quantile c
  // of what it is for resampled blocks about the sample's own difference, stretched for few and for correlated blocks. The true
  // difference lies in D +- c (triangle inequality) in 95 % of samples, and where there is none D stays below c in as many.
  struct ForceChains
  {
    ChainDistribution inside, outside;
    Interval          largest_distance;
    int               blocks = 0; // that hold something inside, or something outside: the smaller number
    std::string       verdict;
  };

  // A zone that no pattern sees, to this much of all grains.
  constexpr double chain_margin = 0.1;

  // Grains: |major principal stress| of single grains (moment / disc area); contacts: size of the force, those that bear one.
  // Inside: centre or contact point in the zone. Only what lies farther than `margin` [length] from the outline's edges counts:
  // chains end at platens and free sides. Verdict: "differs" (D - c > 0), "ignores the zone" (D + c <= chain_margin), else "no
  // difference seen". Each grain counts once, those without force too.
  ForceChains grain_force_chains(const BandZone                     &zone,
                                 const std::vector<Eigen::Vector2d> &outline,
                                 const GrainNetwork                 &network,
                                 double                              margin,
                                 const BootstrapOptions             &options);

  ForceChains contact_force_chains(const BandZone                     &zone,
                                   const std::vector<Eigen::Vector2d> &outline,
                                   const GrainNetwork                 &network,
                                   double                              margin,
                                   const BootstrapOptions             &options);
} // namespace diptych::coupling
