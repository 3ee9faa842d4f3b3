// diptych: the comparison as files
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <string>

#include "coupling/comparison/comparison.h"
#include "coupling/numbers/number_entry.h"

namespace diptych::coupling
{
  // Columns of comparison.csv, a line a number of comparison.json.
  inline std::array<NumberEntry, 8> comparison_columns()
  {
    return {{{"progress_from", "as walk says",
              "beginning of the window or stage as the scene gives it; empty where the number is of the whole run"},
             {"progress_to", "as walk says", "its end"},
             {"panel", "-", "discrete, continuum, difference or mapping, or the part of comparison.json that the number is of"},
             {"quantity", "-", "keys on the way to the number; entries of lists count from 1, or have their name"},
             {"value", "as unit says", "the number"},
             {"low", "as unit says", "lower end of its 95 % interval, where it carries one"},
             {"high", "as unit says", "upper end"},
             {"unit", "-", "of the three"}}};
  }

  // comparison.json: every number that comparison_numbers.h lists, and under "numbers" what each of them is. comparison.csv: the
  // same, one line a number: progress_from and progress_to as the scene gives its stages, panel, quantity, value and, where they
  // are known, the ends of its 95 % interval, unit.
  void write_comparison(const std::string &directory, const Scene &scene, const Comparison &c);

  // comparison.h5: the arrays behind the report's pictures, as comparison_arrays.h lists them.
  void write_comparison_h5(const std::string &directory, const Scene &scene, const Comparison &c, const Results &results);

  // fields.vtu: the last stage, both panels on the continuum's mesh in its position of that stage: every field of CellFields
  // under its name in comparison.h5, tensors as 3x3 tensors (compression positive), vectors with three components, and the
  // difference of the stresses. grid.vtu: the same on the regular grid.
  void write_fields_vtu(const std::string &directory, const Comparison &c);
} // namespace diptych::coupling
