// diptych: message for a wrong command line
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include <CLI/App.hpp>

namespace diptych::coupling
{
  // Message with the fault and the options of the command: "diptych compare: ...; options: --help --set --quiet"
  std::string refusal(CLI::App &app, const std::vector<std::string> &words, const CLI::ParseError &error);
} // namespace diptych::coupling
