// diptych: checks whether a band separates the two packs that the platens carry
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "coupling/bands/band.h"

namespace diptych::coupling
{
  inline constexpr double largest_cut_of_a_platen  = 0.1; // largest share of a platen's length on the other pack's side
  inline constexpr double largest_turn_from_travel = 20;  // [degrees]
  inline constexpr double largest_pack_jump        = 1.2; // [platen increments]

  // Moreau (1997) describes two packs, each carried by a platen, and a zone between them. A band is such a zone if
  //   its line leaves the sample by both sides, or cuts off at most a tenth of a platen;
  //   its jump, with dilation, is at most 20 degrees from the travel of the upper platen;
  //   its jump is at most 1.2 of the platen's travel, because packs cannot part faster than the platens that carry them;
  //   its fit has converged.
  // Returns all conditions that fail, as text; empty for a band between two packs.
  std::string objection_to_packs(const Band &band, const SampleFrame &frame, bool converged);
} // namespace diptych::coupling
