// diptych: allowed values of the options of the command line
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <string>
#include <type_traits>
#include <vector>

#include <CLI/App.hpp>

#include "continuum/laws/point_path.h"
#include "coupling/scene/keys.h"
#include "discrete/files/nearest_name.h"
#include "discrete/files/words.h"

namespace diptych::coupling
{
  // Check of an option that names a file or folder. An empty name comes from an unset shell variable and does not mean the
  // default.
  inline std::string is_filled(const std::string &text)
  {
    return text.empty() ? "a name is needed" : "";
  }

  // CLI::Range with a message that names the allowed values.
  template <class Number> CLI::Validator in_range(const Number low, const Number high)
  {
    const std::string kind  = std::is_integral_v<Number> ? "a whole number" : "a number";
    CLI::Validator    range = CLI::Range(low, high);
    range.description(""); // else the help shows it as "INT in [1 - 9]"
    return range.operation([=, check = range](const std::string &text) {
      const bool is_good = check(text).empty();
      return is_good ? "" : "'" + text + "' is not allowed; give " + kind + " from " + text_of(low) + " to " + text_of(high);
    });
  }

  // CLI::IsMember with a message that names the nearest choice.
  inline CLI::Validator one_of(const std::vector<std::string> &names)
  {
    CLI::Validator member = CLI::IsMember(names);
    member.description("");
    return member.operation([=](const std::string &text) {
      const bool is_good = std::count(names.begin(), names.end(), text) > 0;
      return is_good ? ""
                     : "'" + text + "' is none of " + discrete::listed(names) + "; the nearest is '" +
                         discrete::nearest_name(text, names) + "'";
    });
  }

  inline std::string path_help()
  {
    return "path of the loading: " + discrete::listed(choices_of(continuum::NamedPath())) +
           " (default: that of the scene's loading/path, else drained), or a table .csv with three of " +
           discrete::listed(choices_of(continuum::Control())) + " (first row: the start), and progress for viscosity";
  }

  // A named path of a material point, or a table.
  inline std::string path_or_table(const std::string &text)
  {
    const std::vector<std::string> names   = choices_of(continuum::NamedPath());
    const bool                     is_good = std::count(names.begin(), names.end(), text) > 0 || CLI::ExistingFile(text).empty();
    return is_good ? ""
                   : "'" + text + "' is neither a path (" + discrete::listed(names) + "; the nearest is '" +
                       discrete::nearest_name(text, names) + "') nor a file";
  }

} // namespace diptych::coupling
