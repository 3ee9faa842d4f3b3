// diptych: starts other programs and waits for them
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/processes/child_process.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "coupling/processes/stop_signal.h"

namespace diptych::coupling
{
  namespace
  {
    bool belongs_to_mpi_job(const std::string &variable)
    {
      // Permission to run as root belongs to the user, not to the job.
      if (variable.rfind("OMPI_ALLOW_RUN_AS_ROOT", 0) == 0)
        return false;
      for (const char *prefix : {"OMPI_", "PMIX_", "PMI_", "PRTE_", "ORTE_"})
        if (variable.rfind(prefix, 0) == 0)
          return true;
      return false;
    }

    std::vector<char *> pointers(std::vector<std::string> &texts)
    {
      std::vector<char *> result;
      for (std::string &text : texts)
        result.push_back(text.data());
      result.push_back(nullptr);
      return result;
    }

    std::string program_path; // empty: this process's

    std::set<int> &held()
    {
      static std::set<int> descriptors;
      return descriptors;
    }

    // Runs after fork, so only calls that are safe there. The descriptors ascend.
    void close_all_but(const int *const kept, const std::size_t n)
    {
      unsigned int next = 3; // after the standard streams
      for (std::size_t k = 0; k < n; ++k)
        if (const auto one = static_cast<unsigned int>(kept[k]); one >= next)
          {
            if (one > next)
              close_range(next, one - 1, 0);
            fcntl(kept[k], F_SETFD, 0); // stay open in exec
            next = one + 1;
          }
      close_range(next, ~0U, 0); // includes sockets of an MPI job
    }

    [[noreturn]] void become(char *const *words, char *const *environment, const std::vector<int> &kept, const pid_t parent)
    {
      const int input = open("/dev/null", O_RDONLY);
      setpgid(0, 0);
      prctl(PR_SET_PDEATHSIG, SIGTERM);
      if (getppid() != parent) // the parent ended before the line above
        _exit(127);
      dup2(input, STDIN_FILENO);
      close_all_but(kept.data(), kept.size());
      unblock_stop_signals();
      execve(words[0], words, environment);
      _exit(127);
    }

    pid_t launched(const std::vector<std::string> &words)
    {
      std::vector<std::string> arguments = words, variables;
      for (char **variable = environ; *variable != nullptr; ++variable)
        if (!belongs_to_mpi_job(*variable))
          variables.emplace_back(*variable);
      const std::vector<char *> argument_pointers = pointers(arguments), variable_pointers = pointers(variables);
      const std::vector<int>    kept(held().begin(), held().end());
      const pid_t               parent = getpid(), child = fork();
      if (child == 0)
        become(argument_pointers.data(), variable_pointers.data(), kept, parent);
      if (child < 0)
        throw std::runtime_error("cannot start " + words[0] + ": " + std::strerror(errno));
      return child;
    }

    int code_of_status(const int status)
    {
      return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
    }
  } // namespace

  void keep_open_in_programs(const int descriptor)
  {
    held().insert(descriptor);
  }

  void close_in_programs(const int descriptor)
  {
    held().erase(descriptor);
  }

  int run_program(const std::vector<std::string> &words)
  {
    const pid_t program = launched(words);
    int         status  = 0;
    for (;;)
      {
        const pid_t ended = waitpid(program, &status, WNOHANG);
        if (ended < 0 && errno != EINTR)
          throw std::runtime_error(words[0] + " is lost: " + std::strerror(errno));
        if (ended == program && stop_requested())
          throw StoppedOnRequest(words[0] + ": stopped on request");
        if (ended == program)
          return code_of_status(status);
        if (stop_requested())
          kill(program, SIGKILL); // its files are complete only after its last rename
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
      }
  }

  std::string own_path()
  {
    return program_path.empty() ? std::filesystem::read_symlink("/proc/self/exe").string() : program_path;
  }

  void set_own_path(const std::string &path)
  {
    program_path = path;
  }
} // namespace diptych::coupling
