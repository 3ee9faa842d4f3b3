// diptych: starts other programs and waits for them
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include <sys/types.h>

namespace diptych::coupling
{
  // Programs are started with words[0] (a path) and the other words as arguments. Each has its own process group, so that
  // Ctrl-C reaches only this process. They do not inherit the environment of an MPI job, which would make them one of its
  // ranks. They receive SIGTERM when this process ends. They inherit only the file descriptors registered here. Throws
  // std::runtime_error if no process can be made.
  void keep_open_in_programs(int descriptor);
  void close_in_programs(int descriptor);

  // A program that reads lines and answers them. Its standard input and output are the other end of `socket`.
  struct PipedProgram
  {
    pid_t program = 0;
    int   socket  = -1;
  };
  [[nodiscard]] PipedProgram start_piped_program(const std::vector<std::string> &words);

  // Runs a program with this process's output and errors and waits for its end. Returns its exit code, or 128 + signal. On a
  // stop request it kills the program and throws StoppedOnRequest.
  [[nodiscard]] int run_program(const std::vector<std::string> &words);

  // Waits for the end of a program. Returns its exit code as above.
  int wait_for(pid_t program);

  // Asks a program to stop. If SIGINT stopped this process, it sends SIGTERM, and vice versa. The user may have sent the first
  // signal to all processes, and a second SIGINT would kill the program.
  void ask_to_stop(pid_t program);

  // Path of this program.
  std::string own_path();

  // Number of processors that this process may use.
  [[nodiscard]] int n_usable_cores();
} // namespace diptych::coupling
