// diptych: enums that a scene can set, with the names of their values
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>

namespace diptych::discrete
{
  // A key that holds the name of a file. A relative path counts from the folder of the scene file.
  struct FileName
  {
    std::string &path;
  };

  // Each enum that a scene can set has a function choices(E): the only table of its names. Readers and writers of scenes find
  // that function by argument-dependent lookup.
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
} // namespace diptych::discrete
