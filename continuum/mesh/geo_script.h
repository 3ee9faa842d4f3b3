// diptych: what a geometry of the user's must not say
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace diptych::continuum
{
  // gmsh's .geo files are programs. The answer is the text that gmsh may be given: that of the file with blanks for its
  // comments, lines and columns kept. Throws std::invalid_argument naming the file, the line and the word where one says
  // anything but the words that make shapes (geo_words.h), names that begin with a small letter, and variables that are set in
  // it; and where gmsh could take a text for a command (texts and lines longer than its buffers, texts over several lines).
  std::string checked_geo_script(const std::string &file, const std::string &text);
} // namespace diptych::continuum
