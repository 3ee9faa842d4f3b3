// diptych: 95 % intervals of the numbers of a band by block bootstrap
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <vector>

#include "coupling/bands/band.h"
#include "coupling/bands/band_fit.h"
#include "coupling/statistics/block_bootstrap.h"

namespace diptych::coupling
{
  using HoldsBand = std::function<bool(const BandFit &refit, std::size_t band)>;

  // 95 % intervals of each band of a fit: angles in degrees, lengths in mean diameters, jumps in platen increments. Blocks: the
  // sample's box is cut into rectangles of at least bootstrap.block, which are drawn with replacement. Each draw fits the same
  // number of bands again from the found shapes. To save time it uses means over cells of at most 2 mean diameters, Huber's
  // weights of the found fit and a correction factor. Deviations refer to a fit to all cell means, so that the cells cause no
  // bias. Ends: the 2.5 and 97.5 % quantiles of the deviations (half width: of its logarithm), multiplied by
  // bootstrap_factors(). A resample whose refit does not hold the band, or does not converge, is left out for this band. Ends
  // are NaN if that happens in more than a tenth of the resamples, for fewer than 40 resamples or 4 rectangles. The same seed
  // gives the same bits.
  [[nodiscard]] std::vector<BandIntervals> band_intervals(const BandData         &data,
                                                          const BandFit          &fit,
                                                          const BandFitOptions   &sample,
                                                          const BootstrapOptions &bootstrap,
                                                          const HoldsBand        &holds_band);
} // namespace diptych::coupling
