// diptych: the words of gmsh's .geo language, sorted by what they may do
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace diptych::continuum
{
  // Words that only make shapes, sizes, numbers and text.
  bool makes_shapes(const std::string &word);

  // Words that start programs, read or write files, wait for an answer, end gmsh or call names made of text; and the families
  // of options that do. No variable of a script may be called so.
  bool is_never_allowed(const std::string &word);
} // namespace diptych::continuum
