// diptych: reads a list of seeds from the command line
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/scene/seed_list.h"

#include <algorithm>
#include <limits>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace diptych::coupling
{
  namespace
  {
    [[noreturn]] void refuse(const std::string &text, const std::string &why)
    {
      throw std::invalid_argument("--seeds " + text + ": " + why);
    }

    int seed_of(const std::string &text, const std::string &digits)
    {
      // Ten digits do not overflow a long long.
      const long long seed = digits.size() > 10 ? -1 : std::stoll(digits);
      if (seed < 0 || seed > std::numeric_limits<int>::max())
        refuse(text, "seeds must be from 0 to 2147483647");
      return int(seed);
    }
  } // namespace

  std::vector<int> read_seeds(const std::string &text)
  {
    std::vector<int>   seeds;
    std::istringstream in(text + ",");
    for (std::string item; std::getline(in, item, ',');)
      {
        std::smatch match;
        if (!std::regex_match(item, match, std::regex("([0-9]+)(-([0-9]+))?")))
          refuse(text, "'" + item + "' is neither a seed nor a range; write a list like 1-8 or 1,3,5-7");
        const int first = seed_of(text, match[1]), last = match[3].matched ? seed_of(text, match[3]) : first;
        if (last < first)
          refuse(text, "the range " + item + " descends");
        if ((long long)(last)-first + 1 + (long long)(seeds.size()) > most_seeds)
          refuse(text, "at most " + std::to_string(most_seeds) + " seeds are allowed");
        for (long long seed = first; seed <= last; ++seed)
          seeds.push_back(int(seed));
      }
    std::sort(seeds.begin(), seeds.end());
    if (const auto twice = std::adjacent_find(seeds.begin(), seeds.end()); twice != seeds.end())
      refuse(text, "seed " + std::to_string(*twice) + " is given twice");
    return seeds;
  }
} // namespace diptych::coupling
