// diptych: pictures and pages, drawn by the Python package of the report
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "coupling/program/command_line.h"

namespace diptych::coupling
{
  enum class Drawing
  {
    page,        // report.html of a result folder
    ensemble,    // report.html of an ensemble
    study,       // report.html of a study
    calibration, // report.html of a calibration
    step_study   // study_step.png
  };

  std::string report_file(const std::string &directory); // the absolute path of its page

  // Runs the package on a folder as a child of its own. Throws std::runtime_error where it fails.
  void draw(Drawing drawing, const std::string &directory);

  // The same with progress; then tells where the page is.
  void draw_page(const CommandLine &line, Drawing drawing, const std::string &directory);

  int report_again(const CommandLine &line); // report DIR: of a comparison, an ensemble or a study
} // namespace diptych::coupling
