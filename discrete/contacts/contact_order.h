// diptych: order in which contacts are swept
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "discrete/contacts/contact_detection.h"

namespace diptych::discrete
{
  // Indices of the contacts sorted upward along y, the direction of the load. Layers are a tenth of `length` thick; within a
  // layer the given order remains. The order decides the bits of a result, so it depends only on the contacts. Cost O(n).
  std::vector<int> sweep_order(const std::vector<Contact> &contacts, double length);
} // namespace diptych::discrete
