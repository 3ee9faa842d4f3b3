// diptych: wrong input
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <stdexcept>

namespace diptych::coupling
{
  // The text names file, line, key, value and what is allowed.
  struct SceneError : std::invalid_argument
  {
    using std::invalid_argument::invalid_argument;
  };
} // namespace diptych::coupling
