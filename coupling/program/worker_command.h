// diptych: a process of the program that does one command after the other, as its parent asks
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <string>

#include "coupling/processes/task_queue.h"
#include "coupling/program/command_line.h"

namespace diptych::coupling
{
  // The only word of a worker's command line.
  inline constexpr char worker_word[] = "--worker";

  // Reads tasks from standard input (worker.h) until it ends, does each with its output and errors in the task's log, and answers
  // with its exit code on standard output. `execute` is what the program does with a command line.
  int work_for_parent(const std::function<int(const CommandLine &)> &execute);

  // Of this program: --jobs of them on each process, or as many as fit beside each other.
  TaskQueue workers_for(const CommandLine &line, const std::string &noun);
} // namespace diptych::coupling
