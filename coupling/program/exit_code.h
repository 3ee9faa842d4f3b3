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
    invariant      = 1, // a stated one failed: the program is wrong
    wrong_input    = 2,
    not_converged  = 3, // or stopped; what was reached is kept
    system_failure = 4  // a full disk, a folder that cannot be written to, a library or a script that fails
  };

  // 1 for a broken invariant, 2 for wrong input, 4 for everything else that is thrown.
  [[nodiscard]] int code_of(const std::exception &error);

  // The last message on standard error.
  std::string text_of_end(const std::exception &error);
} // namespace diptych::coupling
