// diptych: version and libraries of the program, in words
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace diptych::coupling
{
  // Three lines: program and revision; compiler and kind of build; libraries with the versions found by the build.
  std::string built_with();
} // namespace diptych::coupling
