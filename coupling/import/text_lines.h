// diptych: lines of words and numbers of other codes' text files, with their places
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace diptych::coupling
{
  // A text file in memory, read line by line. Every refusal is a SceneError "FILE, line N: ...".
  class TextLines
  {
  public:
    // Throws SceneError where the file is missing, is a folder, holds nothing or is no text.
    explicit TextLines(const std::string &path);

    const std::string &path() const { return path_; }
    bool               at_end() const { return next_ >= starts_.size(); }
    int                line() const { return int(next_); } // of the line taken last, from 1
    std::string_view   peek() const;                       // the next line, without its end; empty at the end of the file

    // Takes the next line. Throws where there is none: `expected` says what should have stood there.
    std::string_view take(const std::string &expected);
    void             skip() { ++next_; }
    void             rewind() { next_ = 0; }

    [[noreturn]] void refuse(const std::string &why) const; // names the line taken last

    // Finite. `what` names it in the message.
    double number(std::string_view word, const std::string &what) const;
    long   whole(std::string_view word, const std::string &what) const;
    // Positive where it must be.
    double positive(std::string_view word, const std::string &what) const;

  private:
    std::string              path_, text_;
    std::vector<std::size_t> starts_;
    std::size_t              next_ = 0;
  };

  // Separated by blanks and tabs; in a line with commas or semicolons, by these.
  std::vector<std::string_view> words_of(std::string_view line);

  // "contacts_12.txt" has 12; -1 without digits before the ending.
  long number_in_name(const std::string &path);
} // namespace diptych::coupling
