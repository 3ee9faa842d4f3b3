// diptych: positions and velocities of bodies in a step
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "discrete/contacts/contact_detection.h"
#include "discrete/contacts/contact_problem.h"

namespace diptych::discrete
{
  // q += duration v for grains, walls and images.
  void drift(State &state, double duration);

  void take_velocities(const std::vector<BodyVelocity> &v, State &state);

  // Stores the impulses of the acting contacts, and their change from `previous`, for the first guess of the next step.
  // `previous` holds the impulses of the last step. `contacts` ascend in (i, j).
  void keep_impulses(const std::vector<Contact> &contacts,
                     const std::vector<Impulse> &impulses,
                     const std::vector<Impulse> &previous,
                     const std::vector<int>     &acting,
                     State                      &state);
} // namespace diptych::discrete
