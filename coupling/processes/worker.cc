// diptych: a process that executes one task after another
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/processes/worker.h"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <stdexcept>

#include <sys/socket.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

namespace diptych::coupling
{
  std::string text_of(const WorkerTask &task)
  {
    return nlohmann::json{{"words", task.words}, {"log", task.log}}.dump() + "\n";
  }

  WorkerTask read_worker_task(const std::string &line)
  {
    try
      {
        const nlohmann::json task = nlohmann::json::parse(line);
        return {task.at("words"), task.at("log")};
      }
    catch (const nlohmann::json::exception &error)
      {
        throw std::invalid_argument(std::string("a worker received an invalid task: ") + error.what());
      }
  }

  std::string last_words(const std::string &log)
  {
    std::ifstream file(log);
    std::string   last;
    for (std::string line; std::getline(file, line);)
      if (line.find_first_not_of(" \t\r") != std::string::npos)
        last = line;
    return last;
  }

  Worker::~Worker()
  {
    if (process.program != 0)
      close_and_wait();
  }

  double Worker::seconds() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - since).count();
  }

  bool Worker::send(const std::string &line) const
  {
    for (std::size_t sent = 0; sent < line.size();)
      {
        const ssize_t n = ::send(process.socket, line.data() + sent, line.size() - sent, MSG_NOSIGNAL);
        if (n < 0 && errno != EINTR)
          return false;
        sent += std::size_t(std::max<ssize_t>(0, n));
      }
    return true;
  }

  int Worker::close_and_wait()
  {
    const PipedProgram closed = std::exchange(process, PipedProgram{});
    close(closed.socket);
    answer.clear();
    return wait_for(closed.program);
  }

  void Worker::begin(const WorkerTask &task)
  {
    since                  = std::chrono::steady_clock::now();
    works                  = true;
    const std::string line = text_of(task);
    if (process.program != 0 && send(line))
      return;
    if (process.program != 0)
      close_and_wait(); // killed while it was idle
    process = start_piped_program(command);
    send(line); // ended() notices a process that dies at once
  }

  std::optional<int> Worker::ended()
  {
    if (!works)
      return std::nullopt;
    char          part[256];
    const ssize_t n = recv(process.socket, part, sizeof part, MSG_DONTWAIT);
    if (n < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR))
      return std::nullopt;
    if (n <= 0)
      {
        works          = false;
        const int code = close_and_wait();
        return code == 0 ? system_ended_task : code; // it ended without an answer
      }
    answer.append(part, std::size_t(n));
    if (answer.back() != '\n')
      return std::nullopt;
    works = false;
    return std::stoi(std::exchange(answer, ""));
  }

  void Worker::ask_to_stop() const
  {
    if (works)
      coupling::ask_to_stop(process.program);
  }
} // namespace diptych::coupling
