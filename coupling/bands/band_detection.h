// diptych: shear bands in a displacement field, one operator for grains and nodes
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "coupling/bands/band.h"
#include "coupling/bands/band_options.h"
#include "coupling/fields/strain_increment.h"

namespace diptych::coupling
{
  struct BandReport
  {
    std::vector<Band>     bands;                           // strongest jump first; empty: diffuse
    std::array<double, 3> bic         = {{NAN, NAN, NAN}}; // of no, one and two bands; NaN: not fitted, or no valid fit
    std::array<double, 3> residual    = {{NAN, NAN, NAN}}; // robust root mean square of the misfit / |platen increment|
    double                n_effective = 0;                 // independent samples assumed
    bool                  converged   = false;             // of the chosen fit
    // "diffuse", "one band between two packs", "one band, no zone between two packs: ...", "two bands", and why no more
    std::string verdict;
  };

  constexpr int fewest_band_points = 30;

  // Fits no, one and two bands (Huber loss, variable projection) and keeps the number with the lowest BIC; n in it is the number
  // of independent samples, two for each square of the correlation length, not the number of points. A transition as wide as half
  // the sample is not told from the affine background, and one that shears less in its middle than the sample does on average,
  // jump / (2 half width) < platen increment / height, not from what a tanh leaves of a smooth field: neither is a band. Throws
  // std::invalid_argument for fewer than fewest_band_points weighted points, a platen increment of zero or a frame without
  // extent. The seed draws the blocks of the intervals and nothing else.
  [[nodiscard]] BandReport find_bands(const DisplacementField &field,
                                      const SampleFrame       &frame,
                                      const BandOptions       &options = {},
                                      std::uint64_t            seed    = 1);
} // namespace diptych::coupling
