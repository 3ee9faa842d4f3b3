// diptych: reads fields of LMGC90's fixed columns
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string_view>

#include "coupling/import/text_lines.h"

namespace diptych::coupling
{
  // The number after a name. Columns are fixed and may touch ("rlt/H-0.3499289D+01"), so up to 14 characters are read. Throws
  // SceneError naming the line if name or number is missing.
  double lmgc90_field(const TextLines &lines, std::string_view line, std::string_view name);

  // N of " RBDY2 N" below "$bdyty"; 0 for other lines.
  long lmgc90_body_number(const TextLines &lines, std::string_view line);
} // namespace diptych::coupling
