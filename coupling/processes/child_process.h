// diptych: programs run beside this one
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace diptych::coupling
{
  // Starts words[0] (a path) with the other words, its output and errors appended to a file. It is a program of its own: in its
  // own process group, so that Ctrl-C reaches this process alone; without the environment of an MPI job, which would make it one
  // of its ranks; and it gets SIGTERM when this process ends. Throws std::runtime_error where no process or no file can be made.
  [[nodiscard]] pid_t start_program(const std::vector<std::string> &words, const std::string &log);

  // The same with this process's own output and errors, until it has ended. Returns its exit code, 128 + signal where a signal
  // ended it.
  [[nodiscard]] int run_program(const std::vector<std::string> &words);

  // Exit code of a program that has ended, 128 + signal where a signal ended it; nothing while it runs.
  [[nodiscard]] std::optional<int> exit_code_of(pid_t program);

  // Asks a program to stop, by the signal of SIGINT and SIGTERM that did not stop this process: a signal that the user sent to
  // all processes alike must not count twice, because a second SIGINT kills.
  void ask_to_stop(pid_t program);

  // This program's own file.
  std::string own_path();

  // Processors that this process may use.
  [[nodiscard]] int n_usable_cores();
} // namespace diptych::coupling
