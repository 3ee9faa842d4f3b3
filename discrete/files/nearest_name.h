// diptych: the known name nearest to a mistyped one
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

namespace diptych::discrete
{
  // The name in `known` (not empty) with the fewest letters to insert, delete or replace; the first one if several are equal.
  std::string nearest_name(const std::string &name, const std::vector<std::string> &known);
} // namespace diptych::discrete
