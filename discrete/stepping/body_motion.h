// diptych: bodies drift with their velocities and take new ones
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "discrete/contacts/contact_detection.h"
#include "discrete/contacts/contact_problem.h"

namespace diptych::discrete
{
  // q += duration v for grains, walls and the cell.
  void drift(State &state, double duration);

  // Velocities of a solved problem to grains that are not held, walls and the cell.
  void take_velocities(const std::vector<BodyVelocity> &v, State &state);

  // Keeps the impulses of the contacts that act for the next step's first guess, and what `previous`, those of the step before,
  // has become of. `contacts` ascend in (i, j).
  void keep_impulses(const std::vector<Contact> &contacts,
                     const std::vector<Impulse> &impulses,
                     const std::vector<Impulse> &previous,
                     const std::vector<int>     &acting,
                     State                      &state);
} // namespace diptych::discrete
