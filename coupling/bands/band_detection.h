// diptych: detection of shear bands in a displacement field, the same for grains and nodes
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
    std::array<double, 3> bic         = {{NAN, NAN, NAN}}; // for no, one and two bands; NaN: not fitted, or no valid fit
    std::array<double, 3> residual    = {{NAN, NAN, NAN}}; // robust root mean square of the misfit / |platen increment|
    double                n_effective = 0;                 // assumed number of independent samples
    bool                  converged   = false;             // true if the chosen fit converged
    // "diffuse", "one band between two packs", "one band, no zone between two packs: ..." or "two bands", then why there is no
    // further band.
    std::string verdict;
  };

  constexpr int fewest_band_points = 30;

  // Fits no, one and two bands (Huber loss, variable projection) and chooses the number with the lowest BIC. The n of the BIC
  // is the number of independent samples, two for each square of the correlation length. Two kinds of transitions are not
  // bands. One as wide as half the sample cannot be distinguished from the affine background. One with jump / (2 half width) <
  // platen increment / height shears less in its middle than the sample on average. A tanh fits such remainders of a smooth
  // field. The seed draws only the blocks of the intervals. Throws std::invalid_argument for fewer than fewest_band_points
  // weighted points, a platen increment of zero or a frame without extent.
  [[nodiscard]] BandReport find_bands(const DisplacementField &field,
                                      const SampleFrame       &frame,
                                      const BandOptions       &options = {},
                                      std::uint64_t            seed    = 1);
} // namespace diptych::coupling
