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
  // Returns true if a band of a refit is still a band.
  using HoldsBand = std::function<bool(const BandFit &refit, std::size_t band)>;

  // 95 % intervals of each band of a fit: angles in degrees, lengths in mean diameters, jumps in platen increments.
  // Blocks: the sample's box is cut into rectangles of at least bootstrap.block, which are drawn with replacement. The same
  // number of bands is fitted again to each draw, starting from the found shapes. To save time the refits use means over cells of
  // at most 2 mean diameters, with Huber's weights of the found fit and a correction factor. Deviations are differences from a
  // fit to all cell means, so that the averaging over cells causes no bias.
  // Ends: the 2.5 and 97.5 % quantiles of the deviations, multiplied by bootstrap_factors() (band_calibration.h). For the half
  // width the deviations of its logarithm are used. Without the factors the intervals would cover the truth in only 68-92 % of
  // cases. A band is lost in a resample, and left out there, if the refit does not hold it or does not converge. Ends are NaN if
  // a band is lost in more than a tenth of the resamples, for fewer than 40 resamples or for fewer than 4 rectangles. The same
  // seed gives the same bits.
  [[nodiscard]] std::vector<BandIntervals> band_intervals(const BandData         &data,
                                                          const BandFit          &fit,
                                                          const BandFitOptions   &sample,
                                                          const BootstrapOptions &bootstrap,
                                                          const HoldsBand        &holds_band);
} // namespace diptych::coupling
