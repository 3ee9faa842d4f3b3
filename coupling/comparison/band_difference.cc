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

  ComparedBands compared_bands(const Increment &increment)
  {
    const std::vector<Band> &grains = increment.discrete.band.bands, &nodes = increment.continuum.band.bands;
    const auto               first = [&](const std::vector<Band> &bands) {
      return bands.empty() ? BandIntervals() : (increment.is_mirror_symmetric ? folded(bands[0]) : bands[0]).interval;
    };
    if (increment.is_mirror_symmetric || grains.empty() || nodes.empty())
      return {first(grains), first(nodes)};
    const auto turn = [&](const Band &band) { return std::abs(line_turn(band.angle_deg, grains[0].angle_deg)); };
    return {grains[0].interval, std::min_element(nodes.begin(), nodes.end(), [&](const Band &a, const Band &b) {
                                  return turn(a) < turn(b);
                                })->interval};
  }

  BandValues band_difference(const Increment &increment)
  {
    const auto [a, b]   = compared_bands(increment);
    const Interval turn = difference_of(a.angle_deg, b.angle_deg);
    const double   line = line_turn(turn.value, 0) - turn.value; // whole half turns
    BandValues     result;
    result.angle_deg    = {turn.value + line, turn.low + line, turn.high + line};
    result.half_width   = difference_of(a.half_width, b.half_width);
    result.width_10_90  = difference_of(a.width_10_90, b.width_10_90);
    result.offset       = difference_of(a.offset, b.offset);
    result.jump         = difference_of(a.jump, b.jump);
    result.dilation_deg = difference_of(a.dilation_deg, b.dilation_deg);
    return result;
  }
} // namespace diptych::coupling
