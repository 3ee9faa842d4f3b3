// diptych: completion of command lines
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

namespace CLI
{
  class App;
}

namespace diptych::coupling
{
  // Options of a command as they are typed: --set, --help.
  std::vector<std::string> option_names(CLI::App &command);

  // For bash, zsh or fish: commands, their options, the keys of a scene behind --set, files else.
  std::string completion_script(CLI::App &app, const std::string &shell);
} // namespace diptych::coupling
