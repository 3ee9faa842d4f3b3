// diptych: memory that is not to be had
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>

namespace diptych::discrete
{
  // No fault of the input, whatever was read: the machine has no more, or lets this process have no more.
  struct OutOfMemory : std::runtime_error
  {
    using std::runtime_error::runtime_error;
  };

  // Also of what the standard library throws by itself: std::bad_alloc, and std::length_error of sizes that no machine has.
  inline bool is_out_of_memory(const std::exception &error)
  {
    return dynamic_cast<const std::bad_alloc *>(&error) != nullptr ||
           dynamic_cast<const std::length_error *>(&error) != nullptr || dynamic_cast<const OutOfMemory *>(&error) != nullptr;
  }

  // What the error says; of memory in words, which the standard library has none for, of a path by its name and what the system
  // says.
  inline std::string text_of(const std::exception &error)
  {
    if (const auto *of_path = dynamic_cast<const std::filesystem::filesystem_error *>(&error); of_path != nullptr)
      return of_path->path1().string() + ": " + of_path->code().message();
    const bool is_told = dynamic_cast<const OutOfMemory *>(&error) != nullptr || !is_out_of_memory(error);
    return is_told ? error.what() : "not enough memory, or this process may not have more (ulimit -v)";
  }

  // Throws std::invalid_argument "PLACE: what the error says", for what is wrong in a file; OutOfMemory where that was the error.
  [[noreturn]] inline void throw_wrong_input(const std::string &place, const std::exception &error)
  {
    if (is_out_of_memory(error))
      throw OutOfMemory(place + ": " + text_of(error));
    throw std::invalid_argument(place + ": " + error.what());
  }
} // namespace diptych::discrete
