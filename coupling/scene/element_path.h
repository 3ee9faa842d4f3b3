// diptych: path of an element test, for the law's point and for a cell of grains
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "continuum/laws/point_path.h"
#include "discrete/panel/options.h"

namespace diptych::coupling
{
  // A name of continuum::NamedPath, or a table.
  struct PathOption
  {
    std::string text = "drained";

    bool names_a_file() const;
  };
  inline std::string text_of(const PathOption &option)
  {
    return option.text;
  }

  // Path of a CSV file from the lateral stress `pressure` and the axial one pressure / k0. Three columns are named like controls;
  // a column `progress` is optional. Strains of the path count from the first row of the file. Throws SceneError with file, line,
  // column and range.
  continuum::PointPath read_path_table(const std::string &file, double pressure, double k0 = 1);

  // As continuum::named_path(). Throws WrongKeys.
  continuum::PointPath named_path_of(continuum::NamedPath name, const continuum::PathSize &size);

  // Path of the cell of grains that `option` names. The size holds the pressure; a name also takes its strain and step.
  discrete::CellPath cell_path(const PathOption &option, const continuum::PathSize &size);
} // namespace diptych::coupling
