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
  // Options of a command in their typed form: --set, --help.
  std::vector<std::string> option_names(CLI::App &command);

  // Script for bash, zsh or fish. It completes commands, options, keys of a scene after --set, and otherwise files.
  std::string completion_script(CLI::App &app, const std::string &shell);
} // namespace diptych::coupling
