// diptych: parts overlapping discs, four independent pairs at a time
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>

namespace diptych::discrete
{
  inline constexpr int pairs_at_once = 4;

  struct alignas(32) Disc
  {
    double x, y, radius;
    double inverse_mass; // 0 for fixed grains
  };

  // Four pairs that share no disc. Empty lanes part a disc of no radius from itself, which does nothing.
  struct FourPairs
  {
    int i[pairs_at_once], j[pairs_at_once];
  };

  // Parts each pair that overlaps by its penetration, in proportion to the inverse masses. Returns the largest penetration that
  // it met and `worst`.
  double part_discs(const FourPairs *pairs, std::size_t n, Disc *discs, double worst);
} // namespace diptych::discrete
