// diptych: a process that does one task after the other
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
  // Exit code of a task that the system ended: no room, no memory, a worker that is lost.
  inline constexpr int system_ended_task = 4;

  // What a worker is asked, one line of JSON, and what it answers: the exit code on a line.
  struct WorkerTask
  {
    std::vector<std::string> words; // of the command line, without the program
    std::string              log;   // output and errors are added to this file
  };
  std::string text_of(const WorkerTask &task);
  WorkerTask  read_worker_task(const std::string &line); // throws std::invalid_argument

  // Last line of a log that says something.
  std::string last_words(const std::string &log);

  // The process is started with its first task, and again where it had died.
  class Worker
  {
  public:
    explicit Worker(std::vector<std::string> command)
        : command(std::move(command))
    {}
    Worker(const Worker &) = delete;
    Worker(Worker &&other) noexcept
        : command(std::move(other.command)),
          process(std::exchange(other.process, Answerer{})),
          answer(std::move(other.answer)),
          works(other.works),
          since(other.since)
    {}
    Worker &operator=(const Worker &) = delete;
    ~Worker(); // ends the process when its task is done

    bool   is_free() const { return !works; }
    double seconds() const; // since its task began

    void               begin(const WorkerTask &task); // throws std::runtime_error where no process can be made
    std::optional<int> ended();                       // exit code of the task, once
    void               ask_to_stop() const;

  private:
    bool send(const std::string &line) const;
    int  bury(); // closes the socket, waits for the process; its exit code

    std::vector<std::string>              command;
    Answerer                              process;
    std::string                           answer; // as far as it has come
    bool                                  works = false;
    std::chrono::steady_clock::time_point since;
  };
} // namespace diptych::coupling
