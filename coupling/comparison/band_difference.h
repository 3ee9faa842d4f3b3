// diptych: how far the strongest bands of the two panels are apart
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/comparison/increment.h"
#include "coupling/statistics/interval.h"

namespace diptych::coupling
{
  // b - a of independent numbers: the distances of the ends from the values add up in squares.
  Interval difference_of(const Interval &a, const Interval &b);

  // Continuum minus grains, of the strongest band of each; of the angles the turn of lines, anticlockwise. Lengths [length]; NaN
  // where a panel shows no band.
  struct BandDifference
  {
    Interval angle_deg, half_width, width_10_90, offset, jump, dilation_deg;
  };
  BandDifference band_difference(const Increment &increment);
} // namespace diptych::coupling
