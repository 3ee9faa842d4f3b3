// diptych: reads dump files of LAMMPS and LIGGGHTS
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "coupling/import/number_table.h"

namespace diptych::coupling
{
  // One instant of a file of `dump custom` (kind ATOMS) or `dump local` (kind ENTRIES).
  struct DumpSection
  {
    long        step = 0;
    std::string kind;
    bool        is_periodic[2] = {false, false}; // along x, y
    NumberTable table;
  };

  bool is_dump(const std::string &path);

  // Throws SceneError naming file, line and the expected text.
  std::vector<DumpSection> read_dump(const std::string &path);
} // namespace diptych::coupling
