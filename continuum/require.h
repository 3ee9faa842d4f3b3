// diptych: checks of input
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <sstream>
#include <stdexcept>

namespace diptych::continuum
{
  // Throws std::invalid_argument with the concatenated `parts` as its text, unless `holds` is true.
  template <class... Text> void require(const bool holds, const Text &...text)
  {
    if (holds)
      return;
    std::ostringstream message;
    (message << ... << text);
    throw std::invalid_argument(message.str());
  }
} // namespace diptych::continuum
