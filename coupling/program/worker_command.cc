// diptych: a process that runs one command after another for its parent
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/worker_command.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iostream>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include <fcntl.h>
#include <unistd.h>

#include "coupling/panels/processes.h"

namespace diptych::coupling
{
  namespace
  {
    // Standard output and errors go into a file while it lives.
    class IntoLog
    {
    public:
      explicit IntoLog(const std::string &log)
          : output(kept(STDOUT_FILENO)),
            errors(kept(STDERR_FILENO))
      {
        const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
        if (file < 0)
          throw std::runtime_error("cannot write " + log + ": " + std::strerror(errno));
        dup2(file, STDOUT_FILENO);
        dup2(file, STDERR_FILENO);
        close(file);
      }
      IntoLog(const IntoLog &)            = delete;
      IntoLog &operator=(const IntoLog &) = delete;
      ~IntoLog()
      {
        std::cout.flush();
        dup2(output, STDOUT_FILENO);
        dup2(errors, STDERR_FILENO);
        close(output);
        close(errors);
      }

    private:
      static int kept(const int stream) { return fcntl(stream, F_DUPFD_CLOEXEC, 3); }

      int output, errors;
    };

    // So that the peak memory of a command is its own, and not that of one before it.
    void forget_peak_memory()
    {
      std::ofstream("/proc/self/clear_refs") << 5;
    }

    int do_task(const nlohmann::json &task, const std::function<int(const CommandLine &)> &execute)
    {
      const IntoLog    log(task.at("log"));
      const ParsedLine parsed = parse_command_line(task.at("words"));
      return parsed.exit_code ? *parsed.exit_code : run_and_report([&] { return execute(parsed.line); }, code_of, text_of_end);
    }
  } // namespace

  int work_for_parent(const std::function<int(const CommandLine &)> &execute)
  {
    for (std::string line; std::getline(std::cin, line);)
      {
        forget_peak_memory();
        const int code = do_task(nlohmann::json::parse(line), execute);
        std::cout << code << std::endl;
      }
    return done;
  }
} // namespace diptych::coupling
