// diptych: takes out what penetration a step has left
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "discrete/contacts/contact_detection.h"

namespace diptych::discrete
{
  // Up to ten Gauss-Seidel sweeps on positions: each closed pair of `contacts` (found at mid-step) is parted by its penetration,
  // in proportion to the inverse masses of grains, free walls and a free cell width. Adds no velocity. Ends as soon as no
  // penetration exceeds `enough` [length].
  void project_positions(State &state, const std::vector<Contact> &contacts, double enough);
} // namespace diptych::discrete
