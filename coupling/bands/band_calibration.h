// diptych: how much too narrow the block bootstrap of a band is, from simulated errors of known correlation
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <vector>

#include "coupling/bands/band_fit.h"
#include "coupling/statistics/block_bootstrap.h"

namespace diptych::coupling
{
  // The reported numbers of a band, in the order angle [radians], log(half width), offset [mean diameters], jump [platen
  // increments], dilation angle [radians].
  using BandNumbers = std::array<double, 5>;

  BandNumbers band_numbers(const BandFit &fit, std::size_t band);

  // Factor for the deviations that a block bootstrap over the tiles gives, one set a band.
  //
  // Blocks as small as the correlation length miss what neighbouring blocks have in common; residuals are smaller than errors;
  // and few blocks make the variance itself uncertain. All three are known for a fit that is linear around the solution and
  // errors of known correlation: errors with one independent sample per square of bootstrap.block = L, correlation exp(-pi
  // r^2/L^2), are put through the fit, and the factor is the 95 % quantile of |error of a number| / (deviation that the blocks of
  // the residuals show), divided by 1.96 (calibration of an interval by simulation, Loh 1987). Never below 1.
  [[nodiscard]] std::vector<BandNumbers> bootstrap_factors(const BandData         &data,
                                                           const BandFit          &fit,
                                                           const Tiles            &tiles,
                                                           const BootstrapOptions &bootstrap);
} // namespace diptych::coupling
