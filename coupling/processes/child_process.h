// diptych: programs run beside this one
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include <sys/types.h>

namespace diptych::coupling
{
  // Programs are started with words[0] (a path) and the other words, each in its own process group, so that Ctrl-C reaches this
  // process alone; without the environment of an MPI job, which would make it one of its ranks; and they get SIGTERM when this
  // process ends. Of its files they hold open what is named here alone, as long as they live. Throws std::runtime_error where no
  // process can be made.
  void hold_in_programs(int descriptor);
  void no_longer_hold_in_programs(int descriptor);

  // A program that reads lines and answers them: its standard input and output are the other end of `socket`.
  struct Answerer
  {
    pid_t program = 0;
    int   socket  = -1;
  };
  [[nodiscard]] Answerer start_answerer(const std::vector<std::string> &words);

  // With this process's own output and errors, until it has ended. Returns its exit code, 128 + signal where a signal ended it.
  // Throws StoppedOnRequest once it has been ended because this one was asked to stop.
  [[nodiscard]] int run_program(const std::vector<std::string> &words);

  // Exit code of a program, as above, when it has ended.
  int wait_for(pid_t program);

  // Asks a program to stop, by the signal of SIGINT and SIGTERM that did not stop this process: a signal that the user sent to
  // all processes alike must not count twice, because a second SIGINT kills.
  void ask_to_stop(pid_t program);

  // This program's own file.
  std::string own_path();

  // Processors that this process may use.
  [[nodiscard]] int n_usable_cores();
} // namespace diptych::coupling
