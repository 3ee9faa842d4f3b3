// diptych: starts other programs and waits for them
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

namespace diptych::coupling
{
  // Programs are started with words[0] (a path) and the other words as arguments. Each has its own process group, so that
  // Ctrl-C reaches only this process. They do not inherit the environment of an MPI job, which would make them one of its
  // ranks. They receive SIGTERM when this process ends. They inherit only the file descriptors registered here. Throws
  // std::runtime_error if no process can be made.
  void keep_open_in_programs(int descriptor);
  void close_in_programs(int descriptor);

  // Runs a program with this process's output and errors and waits for its end. Returns its exit code, or 128 + signal. On a
  // stop request it kills the program and throws StoppedOnRequest.
  [[nodiscard]] int run_program(const std::vector<std::string> &words);

  // The program `diptych`; a process of Python has its path from the one that started it.
  std::string own_path();
  void        set_own_path(const std::string &path);
} // namespace diptych::coupling
