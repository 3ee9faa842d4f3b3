// diptych: names of the enums that a scene can set
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>

namespace diptych::continuum
{
  // Each enum that a scene can set has a function choices(E) beside it. That table lists its names in the order in which they
  // are printed. Readers and writers of scenes find it by argument-dependent lookup and compare texts nowhere else.
  template <class E> std::string name_of(const E value)
  {
    for (const auto &[choice, name] : choices(value))
      if (choice == value)
        return name;
    return "unknown";
  }

  template <class E> std::optional<E> value_of(const std::string &name)
  {
    for (const auto &[choice, its_name] : choices(E()))
      if (name == its_name)
        return choice;
    return std::nullopt;
  }
} // namespace diptych::continuum
