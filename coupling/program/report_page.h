// diptych: the page of a result folder, drawn by the Python package
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace diptych::coupling
{
  std::string report_file(const std::string &directory); // absolute path of the page of a folder

  // Draws the page of a folder in a child process. Files in the folder `next` take the place of older ones, and the page is
  // written there. Throws std::runtime_error if it fails.
  void draw_page(const std::string &directory, const std::string &next);
} // namespace diptych::coupling
