// diptych: reads a list of seeds from the command line
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

namespace diptych::coupling
{
  inline constexpr int most_seeds = 10000;

  // "1-8" or "1,3,5-7", returned ascending. Throws std::invalid_argument for other text, numbers outside 0 .. 2147483647,
  // descending ranges, repeated seeds, and more than most_seeds of them.
  std::vector<int> read_seeds(const std::string &text);
} // namespace diptych::coupling
