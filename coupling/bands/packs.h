// diptych: whether a band is a zone between the two packs that the platens carry
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "coupling/bands/band.h"

namespace diptych::coupling
{
  inline constexpr double largest_cut_of_a_platen  = 0.1; // of its length, that may lie on the other pack's side
  inline constexpr double largest_turn_from_travel = 20;  // [degrees]
  inline constexpr double largest_pack_jump        = 1.2; // [platen increments]

  // Moreau (1997) speaks of two packs, each carried by a platen, and a zone between them. A band is such a zone where
  //   its line leaves the sample by both sides, or cuts off at most a tenth of a platen;
  //   its sides part as the platens do: the jump at most 20 degrees from the travel of the upper one, dilation included (zones of
  //   the reference scene: 4 to 13; in a sample with W/H = 1.5: 22 to 33);
  //   its jump is at most 1.2 of the platen's travel: packs cannot part faster than what carries them;
  //   its fit has converged.
  // Returns what is not so, in words, one reason after the other; empty for a zone between two packs.
  std::string objection_to_packs(const Band &band, const SampleFrame &frame, bool converged);
} // namespace diptych::coupling
