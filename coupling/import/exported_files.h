// diptych: files written for another code
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace diptych::coupling
{
  using ExportedFiles = std::vector<std::pair<std::string, std::string>>; // name and text of each file
} // namespace diptych::coupling
