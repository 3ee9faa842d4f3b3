// diptych: reads fields of LMGC90's fixed columns
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/import/lmgc90_text.h"
#include "discrete/files/words.h"

namespace diptych::coupling
{
  double lmgc90_field(const TextLines &lines, const std::string_view line, const std::string_view name)
  {
    const std::size_t at = line.find(name);
    if (at == std::string_view::npos)
      lines.refuse("expected '" + std::string(name) + "'");
    return lines.number(discrete::trimmed(line.substr(at + name.size(), 14)), std::string(name));
  }

  long lmgc90_body_number(const TextLines &lines, const std::string_view line)
  {
    const auto words = words_of(line);
    return words.size() == 2 && words[0] == "RBDY2" ? lines.whole(words[1], "the number of the body") : 0;
  }
} // namespace diptych::coupling
