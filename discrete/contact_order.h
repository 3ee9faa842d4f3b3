// diptych: the order in which contacts are swept
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "discrete/contact_detection.h"

namespace diptych::discrete
{
  // Contacts sorted along y (the direction in which the platens load the sample), then regrouped so that four consecutive
  // ones share no grain as far as a window of 64 allows: the next update need not wait for the last one's velocities.
  // The order is part of the definition of a result: it depends on nothing but the contacts.
  std::vector<Contact> sweep_order(const std::vector<Contact> &contacts, int n_grains);
} // namespace diptych::discrete
