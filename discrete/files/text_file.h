// diptych: text files that are whole or absent, and tables that grow at their end
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace diptych::discrete
{
  // `path`.part, under which a file is written; a link that stands there is removed, so that nothing is written where it leads.
  std::string temporary_for(const std::string &path);

  // Writes under `path`.part, then renames. Throws std::runtime_error naming the file and what the system says; the file of that
  // name stays as it was.
  void write_text(const std::string &path, const std::string &text);

  // The whole file, byte by byte; empty where it cannot be read.
  std::string read_text(const std::string &path);

  // A long reading calls this now and then. It may throw to leave; the exception passes to the caller. Empty: never stops.
  using CheckStop = std::function<void()>;

  inline void call(const CheckStop &check_stop)
  {
    if (check_stop)
      check_stop();
  }

  // Throws std::invalid_argument where `path` is there but no regular file: opening a FIFO waits for its writer, and a device may
  // never come to an end.
  void require_regular_file(const std::string &path);

  // A text that somebody else wrote, in a regular file: at most `most_bytes` of UTF-8 without zeros. A byte order mark at its
  // begin is left out. Throws std::invalid_argument naming the file and, for a byte that is none of a text, its line.
  std::string read_input(const std::string &path, std::size_t most_bytes, const CheckStop &check_stop = {});

  // Index of the first byte that is none of a text in UTF-8 (a zero, a sequence that is cut, overlong or a surrogate); npos:
  // none.
  std::size_t first_non_utf8(const std::string &text);

  // Adds whole lines to the end of a file, in one write; no earlier byte is touched. Throws std::runtime_error naming the file;
  // what was written of the lines is cut off again.
  void append_text(const std::string &path, const std::string &lines);

  // Keeps the first n lines (all, where there are not so many). Throws std::runtime_error naming the file.
  void keep_lines(const std::string &path, std::size_t n);
} // namespace diptych::discrete
