// diptych: checks whether a band separates the two packs that the platens carry
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/bands/packs.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "coupling/cells/principal_axes.h"

namespace diptych::coupling
{
  namespace
  {
    // Share of a platen's length on the far side of the band. `height`: y of the platen relative to the sample's centre [length].
    double cut_share(const Band &band, const SampleFrame &frame, const double height)
    {
      const Eigen::Vector2d n = band.normal();
      if (std::abs(n.x()) < 1e-12) // for a level line: the whole platen or nothing
        return (height > 0) == (n.y() * height > band.offset) ? 0 : 1;
      const double crossing = (band.offset - n.y() * height) / n.x(); // x at which the line crosses the platen, relative to the
                                                                      // centre
      const double left = std::clamp(crossing / frame.width + 0.5, 0., 1.);
      // If n.x > 0, the part to the right of the crossing is on the side of n, the upper side.
      const double upper = n.x() > 0 ? 1 - left : left;
      return height > 0 ? 1 - upper : upper;
    }

    std::string rounded(const double value)
    {
      std::ostringstream out;
      out.precision(4);
      out << value;
      return out.str();
    }
  } // namespace

  std::string objection_to_packs(const Band &band, const SampleFrame &frame, const bool converged)
  {
    std::string reasons;
    const auto  object = [&](const std::string &reason) { reasons += (reasons.empty() ? "" : "; ") + reason; };
    for (const auto &[name, height] : {std::pair{"upper", 0.5 * frame.height}, std::pair{"lower", -0.5 * frame.height}})
      if (const double share = cut_share(band, frame, height); share > largest_cut_of_a_platen)
        object("its line cuts off " + rounded(100 * share) + " % of the " + name + " platen");

    const double          dilation = band.dilation_deg * degree;
    const Eigen::Vector2d apart    = std::copysign(std::cos(dilation), band.jump) * band.direction() +
                                  std::sin(dilation) * band.normal();
    const double turn = std::acos(std::clamp(apart.dot(frame.platen_increment.normalized()), -1., 1.)) / degree;
    if (!(turn <= largest_turn_from_travel))
      object("its sides part at " + rounded(turn) + " degrees to the platen's travel, more than " +
             rounded(largest_turn_from_travel));
    if (std::abs(band.jump) > largest_pack_jump)
      object("its jump is " + rounded(std::abs(band.jump)) + " of the platen's travel, more than " + rounded(largest_pack_jump));
    if (!converged)
      object("its fit has not converged");
    return reasons;
  }
} // namespace diptych::coupling
