// diptych: what a mistyped name was probably meant to be
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

namespace diptych::discrete
{
  // The one of `known` (not empty) that takes the fewest letters inserted, deleted or exchanged; of equals the first.
  std::string nearest_name(const std::string &name, const std::vector<std::string> &known);
} // namespace diptych::discrete
