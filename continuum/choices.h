// diptych: what a scene may choose from, as enums
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>

namespace diptych::continuum
{
  // An enum that a scene may set has a function choices(E) beside it: the one table of its names, in the order in which they are
  // told. Readers and writers of scenes find it by argument-dependent lookup; nothing else compares texts.
  template <class E> std::string name_of(const E value)
  {
    for (const auto &[choice, name] : choices(value))
      if (choice == value)
        return name;
    return "unknown";
  }

  // The value of that name; none where the enum has no such name.
  template <class E> std::optional<E> value_of(const std::string &name)
  {
    for (const auto &[choice, its_name] : choices(E()))
      if (name == its_name)
        return choice;
    return std::nullopt;
  }
} // namespace diptych::continuum
