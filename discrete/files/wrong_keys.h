// diptych: keys of a scene whose values are not allowed together
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace diptych::discrete
{
  // Keys as section/key. The one that is probably wrong comes first.
  struct WrongKeys : std::invalid_argument
  {
    WrongKeys(std::vector<std::string> keys, const std::string &text)
        : std::invalid_argument(text),
          keys(std::move(keys))
    {}

    std::vector<std::string> keys;
  };
} // namespace diptych::discrete
