// diptych: writes a comparison to files
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <string>

#include "coupling/comparison/comparison_numbers.h"
#include "coupling/numbers/number_entry.h"

namespace diptych::coupling
{
  // Columns of comparison.csv, one line per number of comparison.json.
  inline std::array<NumberEntry, 8> comparison_columns()
  {
    return {{{"progress_from", "strain or time",
              "beginning of the window or stage as the scene gives it; empty for a number of the whole run"},
             {"progress_to", "strain or time", "progress at the end of the window or stage"},
             {"panel", "-", "discrete, continuum, difference or mapping, or the part of comparison.json that holds the number"},
             {"quantity", "-", "keys on the path to the number; entries of lists are numbered from 1, or have their name"},
             {"value", "as in unit", "value of the number"},
             {"low", "as in unit", "lower end of the 95 % interval, if there is one"},
             {"high", "as in unit", "upper end of the 95 % interval, if there is one"},
             {"unit", "-", "unit of value, low and high"}}};
  }

  // comparison.json: every number that comparison_numbers.h lists, with their descriptions under "numbers". The same numbers,
  // one per line, go to comparison.csv with the columns comparison_columns(). key_numbers() and the count of the checks go to
  // summary.csv.
  void write_comparison(const std::string &directory, const ComparisonDocument &document);

  // comparison.h5: the arrays behind the report's figures, as listed in comparison_arrays.h.
  void write_comparison_h5(const std::string &directory, const ComparisonDocument &document, const Results &results);

  // fields.pvd: all stages of both panels on the continuum's mesh in its current position. It has every field of CellFields under
  // its name in comparison.h5, and the difference of the stresses. Tensors are 3x3 tensors (positive in compression), and vectors
  // have three components.
  void write_fields(const std::string &directory, const Comparison &c);
} // namespace diptych::coupling
