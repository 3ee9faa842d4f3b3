// diptych: reads lines of words and numbers from other codes' text files
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace diptych::coupling
{
  // A text file in memory, read line by line. Every error is a SceneError "FILE, line N: ...".
  class TextLines
  {
  public:
    // Throws SceneError if the file is missing, a folder, empty or not a text.
    explicit TextLines(const std::string &path);

    const std::string &path() const { return path_; }
    bool               at_end() const { return next_ >= starts_.size(); }
    int                line() const { return int(next_); } // number of the line taken last, from 1
    std::string_view   peek() const;                       // the next line without its end; empty at the end of the file

    // Takes the next line. At the end of the file it throws; `expected` describes the missing text.
    std::string_view take(const std::string &expected);
    void             skip() { ++next_; }
    void             rewind() { next_ = 0; }

    [[noreturn]] void refuse(const std::string &why) const; // names the line taken last

    // A finite number. `what` describes it in messages.
    double number(std::string_view word, const std::string &what) const;
    long   whole(std::string_view word, const std::string &what) const;
    // The same, above 0.
    double positive(std::string_view word, const std::string &what) const;

  private:
    std::string              path_, text_;
    std::vector<std::size_t> starts_;
    std::size_t              next_ = 0;
  };

  // Words separated by commas or semicolons if the line has any, else by blanks and tabs.
  std::vector<std::string_view> words_of(std::string_view line);

  // The last number in a file name: 12 for "contacts_12.txt"; -1 without digits.
  long number_in_name(const std::string &path);
} // namespace diptych::coupling
