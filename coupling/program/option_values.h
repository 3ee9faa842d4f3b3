// diptych: what an option of the command line may be
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <string>

#include <CLI/App.hpp>

namespace diptych::coupling
{
  // Of an option that names a file or folder: an unset variable of a shell is no wish for the default.
  inline std::string is_filled(const std::string &text)
  {
    return text.empty() ? "a name is needed" : "";
  }

  // The few values of an option or a word, divided by spaces; empty where they are not few. CLI11 tells them as TEXT:{a,b}.
  inline std::string values_of(const CLI::Option &option)
  {
    const std::string type = option.get_type_name();
    const std::size_t open = type.find('{'), close = type.find('}');
    if (open == std::string::npos || close == std::string::npos)
      return "";
    std::string values = type.substr(open + 1, close - open - 1);
    std::replace(values.begin(), values.end(), ',', ' ');
    return values;
  }
} // namespace diptych::coupling
