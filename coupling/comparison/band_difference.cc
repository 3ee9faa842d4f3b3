// diptych: differences between the bands of the two panels
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/comparison/band_difference.h"

#include <algorithm>
#include <cmath>

#include "coupling/cells/principal_axes.h"

namespace diptych::coupling
{
  Interval difference_of(const Interval &a, const Interval &b)
  {
    const double value = b.value - a.value;
    return {value, value - std::hypot(b.value - b.low, a.high - a.value), value + std::hypot(b.high - b.value, a.value - a.low)};
  }

  static BandIntervals compared(const Band &band)
  {
    BandIntervals numbers = band.interval;
    if (band.is_diffuse)
      numbers.angle_deg = {};
    return numbers;
  }

  ComparedBands compared_bands(const Increment &increment)
  {
    const std::vector<Band> &grains = increment.discrete.band.bands, &nodes = increment.continuum.band.bands;
    const auto               first = [&](const std::vector<Band> &bands) {
      return bands.empty() ? BandIntervals() : compared(increment.is_mirror_symmetric ? folded(bands[0]) : bands[0]);
    };
    if (increment.is_mirror_symmetric || grains.empty() || nodes.empty())
      return {first(grains), first(nodes)};
    const auto turn = [&](const Band &band) { return std::abs(line_turn(band.angle_deg, grains[0].angle_deg)); };
    return {compared(grains[0]), compared(*std::min_element(nodes.begin(), nodes.end(),
                                                            [&](const Band &a, const Band &b) { return turn(a) < turn(b); }))};
  }

  BandValues band_difference(const Increment &increment)
  {
    const ComparedBands bands = compared_bands(increment);
    const auto          of    = [&](Interval BandValues::*member) { // nothing is random in the continuum
      const double exact = (bands.continuum.*member).value;
      return difference_of(bands.grains.*member, {exact, exact, exact});
    };
    const Interval turn = of(&BandValues::angle_deg);
    const double   line = line_turn(turn.value, 0) - turn.value; // whole half turns
    BandValues     result;
    result.angle_deg    = {turn.value + line, turn.low + line, turn.high + line};
    result.half_width   = of(&BandValues::half_width);
    result.width_10_90  = of(&BandValues::width_10_90);
    result.offset       = of(&BandValues::offset);
    result.jump         = of(&BandValues::jump);
    result.dilation_deg = of(&BandValues::dilation_deg);
    return result;
  }
} // namespace diptych::coupling
