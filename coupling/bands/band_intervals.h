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
  // at most 2 mean diameters, with Huber's weights of the found fit and a correction factor. Deviations are counted from a fit to
  // all of these means, so the cells shift nothing.
  // Ends: 2.5 and 97.5 % quantiles of the deviations, for the half width of its logarithm, stretched by bootstrap_factors()
  // (band_calibration.h). Without stretching they would cover the truth in only 68-92 % of cases. A band counts as lost, and is
  // left out, if the refit does not hold it or does not converge. Ends are NaN if more than a tenth is lost, for fewer than 40
  // resamples or fewer than 4 rectangles. The same seed gives the same bits.
  [[nodiscard]] std::vector<BandIntervals> band_intervals(const BandData         &data,
                                                          const BandFit          &fit,
                                                          const BandFitOptions   &sample,
                                                          const BootstrapOptions &bootstrap,
                                                          const HoldsBand        &holds_band);
} // namespace diptych::coupling
