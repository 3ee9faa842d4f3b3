// diptych: what a quantity of a study may be read from, and what it is
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "coupling/studies/study.h"

namespace diptych::coupling
{
  // Stands for the seed of the sample in a setting's value: sample/file = relaxed_{seed}.h5.
  inline constexpr char seed_word[] = "{seed}";

  // A setting with a seed in the place of that word.
  Entry with_seed(Entry entry, const std::string &seed);

  // Columns of a source's table that are numbers; none for a comparison.
  std::vector<std::string> column_names(Source source);

  // Fills in unit and is_line from the list of the source's numbers. Throws std::invalid_argument where no number of a comparison
  // ends with such a key.
  void describe(StudyQuantity &quantity);

  // "discrete volumetric_strain at 0.015", "discrete strength 0.005-0.015", the number's own name
  std::string default_name(const StudyQuantity &quantity);
} // namespace diptych::coupling
