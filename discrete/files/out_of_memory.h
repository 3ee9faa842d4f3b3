// diptych: errors from a lack of memory
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>

namespace diptych::discrete
{
  // The machine has no more memory, or this process may not have more. This is not a fault of the input.
  struct OutOfMemory : std::runtime_error
  {
    using std::runtime_error::runtime_error;
  };

  // True also for exceptions of the standard library: std::bad_alloc, and std::length_error for impossible sizes.
  inline bool is_out_of_memory(const std::exception &error)
  {
    return dynamic_cast<const std::bad_alloc *>(&error) != nullptr ||
           dynamic_cast<const std::length_error *>(&error) != nullptr || dynamic_cast<const OutOfMemory *>(&error) != nullptr;
  }

  // The text of an error. Out of memory: our own words, because the standard library has none. File system error: the path and
  // the message of the system. Otherwise: what().
  inline std::string text_of(const std::exception &error)
  {
    if (const auto *file_error = dynamic_cast<const std::filesystem::filesystem_error *>(&error); file_error != nullptr)
      return file_error->path1().string() + ": " + file_error->code().message();
    const bool has_text = dynamic_cast<const OutOfMemory *>(&error) != nullptr || !is_out_of_memory(error);
    return has_text ? error.what() : "not enough memory, or this process may not have more (ulimit -v)";
  }

  // Reports a fault in the file that `key` names. Throws std::invalid_argument "FILE, line 3: text of the error (file of KEY)",
  // or OutOfMemory.
  [[noreturn]] inline void throw_wrong_input(const std::string &key, const std::string &file, const std::exception &error)
  {
    const std::string text  = text_of(error);
    const std::string whole = (text.rfind(file, 0) == 0 ? text : file + ": " + text) + " (file of " + key + ")";
    if (is_out_of_memory(error))
      throw OutOfMemory(whole);
    throw std::invalid_argument(whole);
  }
} // namespace diptych::discrete
