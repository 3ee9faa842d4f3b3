// diptych: columns and numbers that a quantity of a study can be read from
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "coupling/studies/study.h"

namespace diptych::coupling
{
  // Replaced by the seed of the sample in a value: sample/file = relaxed_{seed}.h5.
  inline constexpr char seed_word[] = "{seed}";

  // A setting with that word replaced by a seed.
  Entry with_seed(Entry entry, const std::string &seed);

  // Numeric columns of a table; empty for a comparison.
  std::vector<std::string> column_names(Source source);

  // Fills in unit and is_line from the list of the source's numbers. Throws std::invalid_argument if no number of a comparison
  // has the last word of the name as its key.
  void describe(StudyQuantity &quantity);

  // "discrete volumetric_strain at 0.015", "discrete strength 0.005-0.015", or the name of the number.
  std::string default_name(const StudyQuantity &quantity);
} // namespace diptych::coupling
