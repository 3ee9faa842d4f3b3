// diptych: trims and joins words
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace diptych::discrete
{
  inline std::string_view trimmed(const std::string_view text)
  {
    constexpr char    blanks[] = " \t\r\n\f\v";
    const std::size_t first    = text.find_first_not_of(blanks);
    return first == std::string_view::npos ? "" : text.substr(first, text.find_last_not_of(blanks) - first + 1);
  }

  // "a b c"
  inline std::string joined(const std::vector<std::string> &words, const std::string &between = " ")
  {
    std::string text;
    for (const std::string &word : words)
      text += (text.empty() ? "" : between) + word;
    return text;
  }

  // "a, b, c"
  inline std::string listed(const std::vector<std::string> &words)
  {
    return joined(words, ", ");
  }
} // namespace diptych::discrete
