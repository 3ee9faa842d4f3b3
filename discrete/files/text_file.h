// diptych: text files that are complete or absent, and files to which lines are appended
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace diptych::discrete
{
  // Returns `path`.part, the temporary name of a file. Removes a symbolic link of this name, so that its target is not written.
  std::string temporary_for(const std::string &path);

  // Writes to `path`.part, then renames it. On failure an earlier file stays. Throws std::runtime_error with file and cause.
  void write_text(const std::string &path, const std::string &text);

  // All bytes of a file; empty if it cannot be read.
  std::string read_text(const std::string &path);

  // Called regularly while a long file is read. It may throw to stop; the exception passes to the caller. Empty: never stops.
  using CheckStop = std::function<void()>;

  inline void call(const CheckStop &check_stop)
  {
    if (check_stop)
      check_stop();
  }

  // Throws std::invalid_argument if `path` exists and is not a regular file. A FIFO would wait for its writer; a device may
  // have no end.
  void require_regular_file(const std::string &path);

  // Reads at most `most_bytes` bytes of UTF-8 without zeros from a regular file of unknown origin; a byte order mark is left
  // out. Throws std::invalid_argument with the file's name, and with the line of a byte that is not valid UTF-8.
  std::string read_input(const std::string &path, std::size_t most_bytes, const CheckStop &check_stop = {});

  // Index of the first byte that is zero or not valid UTF-8 (cut or overlong sequences, surrogates), or npos.
  std::size_t first_non_utf8(const std::string &text);

  // Appends complete lines to a file in one write; no earlier byte changes. If the write fails, a partly written line is removed.
  // Throws std::runtime_error with the file's name.
  void append_text(const std::string &path, const std::string &lines);

  // Keeps the first n lines of a file, or all if it has fewer. Throws std::runtime_error with the file's name.
  void keep_lines(const std::string &path, std::size_t n);
} // namespace diptych::discrete
