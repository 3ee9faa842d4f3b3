// diptych: a shear band
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/bands/band.h"

namespace diptych::coupling
{
  Band folded(const Band &band)
  {
    const auto negative = [](const Interval &i) { return Interval{-i.value, -i.high, -i.low}; };
    if (band.angle_deg >= 0)
      return band;
    Band mirrored               = band;
    mirrored.angle_deg          = -band.angle_deg;
    mirrored.jump               = -band.jump;
    mirrored.interval.angle_deg = negative(band.interval.angle_deg);
    mirrored.interval.jump      = negative(band.interval.jump);
    return mirrored;
  }
} // namespace diptych::coupling
