// diptych: distributes many runs of the program over workers
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace diptych::coupling
{
  // A command of the program, and the log to which its output and errors are appended.
  struct Task
  {
    std::string              name; // name in messages, for example "seed 3"
    std::vector<std::string> words;
    std::string              log;
  };

  struct TaskOutcome
  {
    std::size_t task        = 0;     // its index in the list
    int         exit_code   = 0;     // 128 + signal if a signal ended its worker
    bool        interrupted = false; // asked to stop, or never started
  };

  struct TaskQueue
  {
    std::vector<std::string> worker; // command that starts a worker; for its answers see worker_command.h
    std::vector<Task>        tasks;
    std::string              noun              = "tasks";
    int                      n_finished_before = 0;
    int                      jobs              = 1; // workers on each process
    bool                     quiet             = false;

    // Called on the first process as tasks end. If it throws, the task has failed.
    std::function<void(const TaskOutcome &)> on_ended = [](const TaskOutcome &) {};
  };

  // A worker is a process that executes one task after another. If it is killed, its task has failed and a new worker replaces
  // it. Under mpirun the first process gives tasks to processes with a free worker. On a stop signal running tasks are asked to
  // stop, and no further task starts. Collective. Returns, on the first process only, one outcome per task, in their order.
  std::vector<TaskOutcome> run_tasks(const TaskQueue &queue);
} // namespace diptych::coupling
