// diptych: the lines of a mesh file, one after the other, with their numbers
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace diptych::continuum
{
  // Goes through a text line by line. Holds views of the text, which must live longer.
  class MshLines
  {
  public:
    MshLines(std::string file, std::string_view text);

    // To the next line that is not blank; false at the end of the text.
    bool next();
    // The same within the section $Name: throws at the end of the text.
    void next_of(const char *section);
    // `count` lines follow in the section: throws where they cannot (a line has two bytes at least).
    void expect_room(std::uint64_t count) const;

    std::size_t             number() const { return line_number; }
    std::string_view        line() const { return current; }
    const std::string_view &word(const std::size_t k) const { return words[k]; }
    std::size_t             n_words() const { return words.size(); }

    // Throws where the line has fewer words or, unless `or_more`, others than `n`; `what` says what they are.
    void expect_words(std::size_t n, const char *what, bool or_more = false) const;
    // A word as a number. Throws where it is no integer in [least, most], or not finite.
    std::uint64_t integer(std::size_t k, const char *what, std::uint64_t least, std::uint64_t most) const;
    double        coordinate(std::size_t k, std::uint64_t node) const;

    // Throws std::invalid_argument: file, line, what.
    [[noreturn]] void refuse(const std::string &what) const { refuse_at(line_number, what); }
    [[noreturn]] void refuse_at(std::size_t line, const std::string &what) const;

  private:
    std::string                   file;
    std::string_view              rest, current;
    std::vector<std::string_view> words;
    std::size_t                   line_number = 0;
  };
} // namespace diptych::continuum
