// diptych: many runs of the program, each by whichever worker is free
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace diptych::coupling
{
  // A command of the program: its words, and the file to which its output and errors are added.
  struct Task
  {
    std::string              name; // "seed 3": what messages call it
    std::vector<std::string> words;
    std::string              log;
  };

  struct TaskOutcome
  {
    std::size_t task        = 0;     // its place in the list
    int         exit_code   = 0;     // 128 + signal where a signal ended its worker
    bool        interrupted = false; // it was asked to stop, or never begun
  };

  struct TaskQueue
  {
    std::vector<std::string> worker; // how one is started: it answers as worker_command.h says
    std::vector<Task>        tasks;
    std::string              noun              = "tasks";
    int                      n_finished_before = 0;
    int                      jobs              = 1; // workers, on each process
    bool                     quiet             = false;

    std::function<void(const TaskOutcome &)> on_ended = [](const TaskOutcome &) {}; // on the first process, as they end; where it
                                                                                    // throws, the task has failed
  };

  // A worker is a process that does one task after the other; when one is killed, its task has failed and another takes its
  // place. Under mpirun the first process hands tasks to whichever process has a free worker. On a stop signal the tasks that run
  // are asked to stop, and no other one begins. Collective. Returns, on the first process alone, one outcome a task, in their
  // order.
  std::vector<TaskOutcome> run_tasks(const TaskQueue &queue);
} // namespace diptych::coupling
