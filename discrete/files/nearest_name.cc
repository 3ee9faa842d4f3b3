// diptych: the known name nearest to a mistyped one
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/files/nearest_name.h"

#include <algorithm>

namespace diptych::discrete
{
  namespace
  {
    // Smallest number of letters inserted, deleted or exchanged between two names (Levenshtein).
    std::size_t edit_distance(const std::string &a, const std::string &b)
    {
      std::vector<std::size_t> row(b.size() + 1);
      for (std::size_t j = 0; j <= b.size(); ++j)
        row[j] = j;
      for (std::size_t i = 1; i <= a.size(); ++i)
        {
          std::size_t diagonal = row[0];
          row[0]               = i;
          for (std::size_t j = 1; j <= b.size(); ++j)
            {
              const std::size_t up = row[j];
              row[j]               = std::min({up + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
              diagonal             = up;
            }
        }
      return row[b.size()];
    }
  } // namespace

  std::string nearest_name(const std::string &name, const std::vector<std::string> &known)
  {
    return *std::min_element(known.begin(), known.end(), [&](const std::string &a, const std::string &b) {
      return edit_distance(name, a) < edit_distance(name, b);
    });
  }
} // namespace diptych::discrete
