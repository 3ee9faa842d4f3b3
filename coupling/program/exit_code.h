// diptych: exit codes and last messages of exceptions
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <exception>
#include <string>

namespace diptych::coupling
{
  enum ExitCode
  {
    done           = 0,
    invariant      = 1, // an internal check failed: a fault of the program
    wrong_input    = 2,
    not_converged  = 3, // or stopped; the results so far are kept
    system_failure = 4  // a full disk, a folder that cannot be written to, a library or a script that fails
  };

  // 1 for a failed internal check, 2 for wrong input, 4 for all other exceptions.
  [[nodiscard]] int code_of(const std::exception &error);

  // The text for the last message on standard error.
  std::string text_of_end(const std::exception &error);
} // namespace diptych::coupling
