// diptych: import FORMAT FILES: starts the importers, which are part of the Python package
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace diptych::coupling
{
  // Replaces this process by `python3 -m diptych.importers`, with the words after "import". Throws SceneError if the program was
  // built without the package, std::runtime_error if Python cannot be started.
  [[noreturn]] void start_importers(char **argv);
} // namespace diptych::coupling
