// diptych: a process that runs one command after another for its parent
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

  // Reads tasks (worker.h) from standard input until its end. Runs each task with output and errors in the task's log, and writes
  // its exit code to standard output. `execute` runs a command line.
  int work_for_parent(const std::function<int(const CommandLine &)> &execute);

  // Queue of workers of this program. Each MPI process starts --jobs workers, or without --jobs as many as its cores allow (under
  // mpirun one).
  TaskQueue workers_for(const CommandLine &line, const std::string &noun);
} // namespace diptych::coupling
