// diptych: the lines of a mesh file, one after the other, with their numbers
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/mesh/msh_lines.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <utility>

namespace diptych::continuum
{
  namespace
  {
    constexpr std::string_view blanks = " \t\r\f\v";

    // What stands in a message of a word of the file.
    std::string shown(const std::string_view word)
    {
      std::string text(word.substr(0, 40));
      std::replace_if(
        text.begin(), text.end(), [](const char c) { return c < ' ' || c > '~'; }, '?');
      return "'" + text + (word.size() > 40 ? "...'" : "'");
    }
  } // namespace

  MshLines::MshLines(std::string file, const std::string_view text)
      : file(std::move(file)),
        rest(text)
  {}

  bool MshLines::next()
  {
    words.clear();
    while (!rest.empty() && words.empty())
      {
        current = rest.substr(0, rest.find('\n'));
        rest.remove_prefix(std::min(rest.size(), current.size() + 1));
        ++line_number;
        for (std::size_t k = 0; (k = current.find_first_not_of(blanks, k)) != std::string_view::npos;)
          {
            const std::size_t end = std::min(current.size(), current.find_first_of(blanks, k));
            words.push_back(current.substr(k, end - k));
            k = end;
          }
      }
    return !words.empty();
  }

  void MshLines::next_of(const char *section)
  {
    if (!next())
      refuse(std::string("the file ends within ") + section);
  }

  void MshLines::expect_room(const std::uint64_t count) const
  {
    if (count > rest.size() / 2)
      refuse("the count " + std::to_string(count) + " is more than the rest of the file can hold");
  }

  void MshLines::expect_words(const std::size_t n, const char *what, const bool or_more) const
  {
    if (words.size() < n || (words.size() > n && !or_more))
      refuse("holds " + std::to_string(words.size()) + " words instead of " + std::to_string(n) + " (" + what + ")");
  }

  std::uint64_t MshLines::integer(const std::size_t   k,
                                  const char         *what,
                                  const std::uint64_t least,
                                  const std::uint64_t most) const
  {
    std::uint64_t value = 0;
    const auto    end   = std::from_chars(words[k].data(), words[k].data() + words[k].size(), value);
    if (end.ec != std::errc() || end.ptr != words[k].data() + words[k].size() || value < least || value > most)
      refuse(std::string(what) + " is " + shown(words[k]) + ", not an integer from " + std::to_string(least) + " to " +
             std::to_string(most));
    return value;
  }

  double MshLines::coordinate(const std::size_t k, const std::uint64_t node) const
  {
    const std::string_view word  = words[k].substr(words[k].size() > 1 && words[k][0] == '+' ? 1 : 0);
    double                 value = 0;
    const auto             end   = std::from_chars(word.data(), word.data() + word.size(), value);
    const bool small = end.ec == std::errc::result_out_of_range && std::abs(std::strtod(std::string(word).c_str(), nullptr)) < 1;
    if ((end.ec != std::errc() && !small) || end.ptr != word.data() + word.size() || !std::isfinite(value))
      refuse("a coordinate of node " + std::to_string(node) + " is " + shown(words[k]) + ", which is not finite or no number");
    return value;
  }

  void MshLines::refuse_at(const std::size_t line, const std::string &what) const
  {
    throw std::invalid_argument(file + ", line " + std::to_string(line) + ": " + what);
  }
} // namespace diptych::continuum
