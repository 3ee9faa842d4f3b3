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
    homogenised, // report.html of homogenised grains
    element,     // report.html of grains and law on one path
    movie        // movie.gif of a result folder
  };

  std::string report_file(const std::string &directory); // absolute path of the page of a folder

  // Draws the results of a folder, in a child process. Files in the folder `next`, if given, take the place of older ones, and
  // the page is written there. Throws std::runtime_error if it fails.
  void draw(Drawing drawing, const std::string &directory, const std::string &next = "");
} // namespace diptych::coupling
