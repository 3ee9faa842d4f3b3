// diptych: what each number of a comparison is
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/numbers/number_schema.h"

namespace diptych::coupling
{
  // Of comparison.json, in the order of comparison_numbers.h.
  NumberSchema comparison_schema();
} // namespace diptych::coupling
