// diptych: factors that widen the bootstrap intervals of a band, from simulated errors of known correlation
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <vector>

#include "coupling/bands/band_fit.h"
#include "coupling/statistics/block_bootstrap.h"

namespace diptych::coupling
{
  // The numbers of a band in this order: angle [radians], log(half width), offset [mean diameters], jump [platen increments],
  // dilation angle [radians].
  using BandNumbers = std::array<double, 5>;

  BandNumbers band_numbers(const BandFit &fit, std::size_t band);

  // Factors for the deviations of a block bootstrap over the tiles, one set per band. Block deviations are too small. Blocks as
  // small as the correlation length miss correlations between neighbours. Residuals are smaller than errors, and a small number
  // of blocks makes the variance uncertain. Simulated errors are put through the linearised fit. Their correlation is exp(-pi
  // r^2/L^2) with L = bootstrap.block: one independent sample per square of side L. The factor is the 95 % quantile of |error
  // of a number| / (deviation from the blocks of the residuals), divided by 1.96. This is the calibration of an interval by
  // simulation (Loh 1987). No factor is below 1.
  [[nodiscard]] std::vector<BandNumbers> bootstrap_factors(const BandData         &data,
                                                           const BandFit          &fit,
                                                           const Tiles            &tiles,
                                                           const BootstrapOptions &bootstrap);
} // namespace diptych::coupling
