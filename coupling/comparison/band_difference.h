// diptych: differences between the bands of the two panels
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/comparison/increment.h"
#include "coupling/statistics/interval.h"

namespace diptych::coupling
{
  // b - a of independent numbers. The distances from the values to the ends are added in squares.
  Interval difference_of(const Interval &a, const Interval &b);

  // Continuum minus grains. In a mirror-symmetric scene two equally probable bands cross, and chance decides which one is
  // stronger: there, the strongest band of each panel is compared, mirrored to a positive angle. Otherwise it is the grains'
  // strongest band and the continuum's band with the nearest angle. Angles are rotations of lines, anticlockwise. Lengths
  // [length]. NaN if a panel has no band.
  struct ComparedBands
  {
    BandIntervals grains, continuum; // NaN without a band; a diffuse zone has no angle
  };
  ComparedBands compared_bands(const Increment &increment);

  BandValues band_difference(const Increment &increment);
} // namespace diptych::coupling
