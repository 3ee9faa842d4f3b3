// diptych: descriptions of the numbers of a comparison
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/numbers/number_schema.h"

namespace diptych::coupling
{
  NumberSchema comparison_schema();
} // namespace diptych::coupling
