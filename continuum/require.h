// diptych: checks of input
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace diptych::continuum
{
  template <class... Text> std::string concatenated(const Text &...text)
  {
    std::ostringstream message;
    (message << ... << text);
    return message.str();
  }

  // Throws std::invalid_argument with the concatenated `text`, unless `holds` is true.
  template <class... Text> void require(const bool holds, const Text &...text)
  {
    if (!holds)
      throw std::invalid_argument(concatenated(text...));
  }

  // Keys of the section continuum whose values are not allowed together. The one that is probably wrong comes first.
  struct WrongKeys : std::invalid_argument
  {
    WrongKeys(std::vector<std::string> keys, const std::string &text)
        : std::invalid_argument(text),
          keys(std::move(keys))
    {}

    std::vector<std::string> keys;
  };

  // As require(); throws WrongKeys.
  template <class... Text> void require_keys(const bool holds, std::vector<std::string> keys, const Text &...text)
  {
    if (!holds)
      throw WrongKeys(std::move(keys), concatenated(text...));
  }
} // namespace diptych::continuum
