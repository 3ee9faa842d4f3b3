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
  // Whether a band of a refit still is one.
  using HoldsBand = std::function<bool(const BandFit &refit, std::size_t band)>;

  // Intervals of each band of a fit: angles in degrees, lengths in mean diameters, jumps in platen increments. The sample's box
  // is cut into rectangles of at least bootstrap.block; they are drawn with replacement, and the same number of bands is fitted
  // again to what is drawn, from the found shapes. So that this costs little, the refits use means over cells of at most 2
  // mean diameters, with Huber's weights of the found fit (and a factor for that); deviations are counted from a fit to all of
  // these means, so that cells shift nothing. Ends: 2.5 and 97.5 % of the deviations (for the half width of its logarithm),
  // stretched by bootstrap_factors() (band_calibration.h), without which they would cover the truth in 68-92 % of cases only. A
  // band that a refit does not hold, or a refit that does not converge, counts as lost and is left out. Ends are NaN where more
  // than a tenth is lost, for fewer than 40 resamples or fewer than 4 rectangles. Same seed, same bits.
  [[nodiscard]] std::vector<BandIntervals> band_intervals(const BandData         &data,
                                                          const BandFit          &fit,
                                                          const BandFitOptions   &sample,
                                                          const BootstrapOptions &bootstrap,
                                                          const HoldsBand        &holds_band);
} // namespace diptych::coupling
