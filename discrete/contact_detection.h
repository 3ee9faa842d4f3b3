// diptych: pairs of bodies that may touch within a step
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "discrete/state.h"

namespace diptych::discrete
{
  // A candidate contact between grain i and body j > i (a grain, or a wall for j >= n_grains).
  struct Contact
  {
    int             i, j;
    double          gap;    // negative where the bodies interpenetrate [length]
    Eigen::Vector2d normal; // unit, from j to i
    Eigen::Vector2d point;  // midway between the surfaces
  };

  // Gap, normal and point of one pair at the present positions.
  Contact make_contact(const State &state, int i, int j);

  // All pairs whose gap is below the sum of their margins (walls have none), ascending in (i, j).
  // `margin` [length] has one entry per grain. Cost O(n): counting sort into cells of the largest diameter.
  std::vector<Contact> find_contacts(const State &state, const std::vector<double> &margin);
} // namespace diptych::discrete
