// diptych: mesh files are checked before gmsh sees them
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace diptych::continuum
{
  // The text of a .msh file as gmsh may be given it: ASCII, MSH 2.2 or 4.1, of its sections the format, physical names,
  // entities, nodes and elements. Throws std::invalid_argument naming the file and the line of what gmsh would take for commands,
  // pass over or read wrongly: text outside of sections, other versions, binary files, counts that do not fit, cut files; tags
  // that are no integers from 1 to 2^31 - 1 or given twice, coordinates that are not finite; elements of nodes that the file does
  // not hold, elements given twice, quadrilaterals that are folded, concave or flat.
  std::string checked_msh_text(const std::string &file, const std::string &text);
} // namespace diptych::continuum
