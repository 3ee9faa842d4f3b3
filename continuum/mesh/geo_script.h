// diptych: what a geometry of the user's must not say
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace diptych::continuum
{
  // gmsh's .geo files are programs. Throws std::invalid_argument naming the file, the line and the word where one would start
  // other programs, end this one, read or write files, or set options that are not those of geometry and mesh.
  void check_geo_script(const std::string &file, const std::string &text);
} // namespace diptych::continuum
