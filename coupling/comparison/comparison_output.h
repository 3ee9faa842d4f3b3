// diptych: the comparison as files
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "coupling/comparison/comparison.h"

namespace diptych::coupling
{
  // comparison.json: every number that comparison_numbers.h lists, and under "numbers" what each of them is. comparison.csv: the
  // same, one line a number: progress_from, progress_to, panel, quantity, value and, where they are known, the ends of its 95 %
  // interval, unit.
  void write_comparison(const std::string &directory, const Scene &scene, const Comparison &c);

  // comparison.h5: the arrays behind the report's pictures, as comparison_arrays.h lists them.
  void write_comparison_h5(const std::string &directory, const Scene &scene, const Comparison &c, const Results &results);

  // fields.vtu: the last stage, both panels on the continuum's mesh in its position of that stage: every field of CellFields
  // under its name in comparison.h5, tensors as 3x3 tensors (compression positive), vectors with three components, and the
  // difference of the stresses. grid.vtu: the same on the regular grid.
  void write_fields_vtu(const std::string &directory, const Comparison &c);
} // namespace diptych::coupling
