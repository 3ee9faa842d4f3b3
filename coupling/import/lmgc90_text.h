// diptych: fields of LMGC90's fixed columns
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string_view>

#include "coupling/import/text_lines.h"

namespace diptych::coupling
{
  // The number behind a name. Columns are fixed and run together ("rlt/H-0.3499289D+01"): up to 14 characters belong to it.
  // Throws SceneError naming the line where the name or the number is not there.
  double lmgc90_field(const TextLines &lines, std::string_view line, std::string_view name);

  // N of " RBDY2   N" below "$bdyty"; 0 where the line is none.
  long lmgc90_body_number(const TextLines &lines, std::string_view line);
} // namespace diptych::coupling
