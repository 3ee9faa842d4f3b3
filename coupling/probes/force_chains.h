// diptych: stresses of single grains inside and outside the shear band: do the force chains differ there?
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
  // Cumulative shares at which a distribution is listed.
  constexpr std::array<double, 11> chain_quantiles = {{0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95}};

  // Values relative to the common mean over inside and outside.
  struct ChainDistribution
  {
    int                    count = 0;                          // number of grains
    double                 mean = NAN, share_above_mean = NAN; // share above 1, the common mean
    std::array<double, 11> values = {};                        // values at chain_quantiles
  };

  // largest_distance: D = largest difference between the two cumulative distributions (Kolmogorov and Smirnov). Its interval is D
  // +- c. `c` is the 95 % quantile of the same distance between two differences: that of resampled blocks and that of the sample.
  // It is widened for a small number of blocks and for correlated blocks. In 95 % of samples the true difference lies in D +- c
  // (triangle inequality). If there is no true difference, D is below c in 95 % of samples.
  struct ForceChains
  {
    ChainDistribution inside, outside;
    Interval          largest_distance;
    int               blocks = 0; // number of blocks with a value inside, or outside if these are fewer
    std::string       verdict;
  };

  // The pattern ignores the band if it differs by at most this share of all grains.
  constexpr double chain_margin = 0.1;

  // |major principal stress| of single grains (moment / disc area), each grain once, also those without force. Inside: the
  // grain's centre lies in the band. Only grains farther than `margin` [length] from the outline's edges count, because chains
  // end at platens and free sides. The verdict is "differs" (D - c > 0), "ignores the zone" (D + c <= chain_margin) or "cannot
  // tell".
  ForceChains grain_force_chains(const BandZone                     &zone,
                                 const std::vector<Eigen::Vector2d> &outline,
                                 const GrainNetwork                 &network,
                                 double                              margin,
                                 const BootstrapOptions             &options);
} // namespace diptych::coupling
