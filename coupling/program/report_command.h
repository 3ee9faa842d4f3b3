// diptych: pictures and pages, drawn by the Python package of the report
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace diptych::coupling
{
  std::string report_file(const std::string &directory); // absolute path of the page of a folder

  // Draws a folder in a child process. what: page or movie of a result folder, ensemble, study, calibration, homogenised or
  // element. Files in the folder `next`, if given, take the place of older ones, and the page is written there.
  // Throws std::runtime_error if it fails.
  void draw(const std::string &what, const std::string &directory, const std::string &next = "");
} // namespace diptych::coupling
