// diptych: completion of command lines for fish
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "coupling/scene/keys.h"

namespace CLI
{
  class App;
}

namespace diptych::coupling
{
  // Commands and options with their meanings, the keys of a scene behind --set (those of few values with each of them), files
  // else.
  std::string fish_completion(CLI::App &app, const std::vector<KeyDescription> &keys);
} // namespace diptych::coupling
