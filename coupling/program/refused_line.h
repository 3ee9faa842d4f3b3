// diptych: words of the command line that are refused
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include <CLI/App.hpp>

namespace diptych::coupling
{
  // What is wrong with a line, and what would be right: "diptych compare: ...; it has --help --set --quiet"
  std::string refusal(CLI::App &app, const std::vector<std::string> &words, const CLI::ParseError &error);
} // namespace diptych::coupling
