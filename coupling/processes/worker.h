// diptych: a process that executes one task after another
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "coupling/processes/child_process.h"

namespace diptych::coupling
{
  // Exit code of a task that the system ended: no space, no memory, or a lost worker.
  inline constexpr int system_ended_task = 4;

  // Protocol: a worker receives its task as one line of JSON and answers with the exit code on a line.
  struct WorkerTask
  {
    std::vector<std::string> words; // command line without the program
    std::string              log;   // output and errors are appended to this file
  };
  std::string text_of(const WorkerTask &task);
  WorkerTask  read_worker_task(const std::string &line); // throws std::invalid_argument

  // Last line of a log that is not blank.
  std::string last_words(const std::string &log);

  // Starts the process with its first task, and again if it has died.
  class Worker
  {
  public:
    explicit Worker(std::vector<std::string> command)
        : command(std::move(command))
    {}
    Worker(const Worker &) = delete;
    Worker(Worker &&other) noexcept
        : command(std::move(other.command)),
          process(std::exchange(other.process, PipedProgram{})),
          answer(std::move(other.answer)),
          works(other.works),
          since(other.since)
    {}
    Worker &operator=(const Worker &) = delete;
    ~Worker(); // waits for the end of the task, then ends the process

    bool   is_free() const { return !works; }
    double seconds() const; // since the task began

    void               begin(const WorkerTask &task); // throws std::runtime_error if no process can be made
    std::optional<int> ended();                       // exit code of the task, returned once
    void               ask_to_stop() const;

  private:
    bool send(const std::string &line) const;
    int  close_and_wait(); // closes the socket, waits for the process and returns its exit code

    std::vector<std::string>              command;
    PipedProgram                          process;
    std::string                           answer; // the part received so far
    bool                                  works = false;
    std::chrono::steady_clock::time_point since;
  };
} // namespace diptych::coupling
