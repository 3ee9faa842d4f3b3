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
#include <sched.h>
#include <sys/prctl.h>
#include <sys/socket.h>
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

    // Replaces standard streams. -1: no input; output and errors of this process.
    struct Streams
    {
      int in = -1, out = -1, errors = -1;
    };

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

    [[noreturn]] void become(char *const            *words,
                             char *const            *environment,
                             const Streams          &streams,
                             const std::vector<int> &kept,
                             const pid_t             parent)
    {
      const int input = streams.in >= 0 ? streams.in : open("/dev/null", O_RDONLY);
      setpgid(0, 0);
      prctl(PR_SET_PDEATHSIG, SIGTERM);
      if (getppid() != parent) // the parent ended before the line above
        _exit(127);
      dup2(input, STDIN_FILENO);
      if (streams.out >= 0)
        dup2(streams.out, STDOUT_FILENO);
      if (streams.errors >= 0)
        dup2(streams.errors, STDERR_FILENO);
      close_all_but(kept.data(), kept.size());
      unblock_stop_signals();
      execve(words[0], words, environment);
      _exit(127);
    }

    pid_t launched(const std::vector<std::string> &words, const Streams &streams)
    {
      std::vector<std::string> arguments = words, variables;
      for (char **variable = environ; *variable != nullptr; ++variable)
        if (!belongs_to_mpi_job(*variable))
          variables.emplace_back(*variable);
      const std::vector<char *> argument_pointers = pointers(arguments), variable_pointers = pointers(variables);
      const std::vector<int>    kept(held().begin(), held().end());
      const pid_t               parent = getpid(), child = fork();
      if (child == 0)
        become(argument_pointers.data(), variable_pointers.data(), streams, kept, parent);
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

  PipedProgram start_piped_program(const std::vector<std::string> &words)
  {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
      throw std::runtime_error("cannot start " + words[0] + ": " + std::strerror(errno));
    try
      {
        const pid_t child = launched(words, {ends[1], ends[1]});
        close(ends[1]);
        return {child, ends[0]};
      }
    catch (const std::exception &)
      {
        close(ends[0]);
        close(ends[1]);
        throw;
      }
  }

  int run_program(const std::vector<std::string> &words)
  {
    const pid_t program = launched(words, {});
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

  int wait_for(const pid_t program)
  {
    int status = 0;
    while (waitpid(program, &status, 0) < 0)
      if (errno != EINTR)
        throw std::runtime_error("process " + std::to_string(program) + " is lost: " + std::strerror(errno));
    return code_of_status(status);
  }

  void ask_to_stop(const pid_t program)
  {
    // The handler in stop_signal.cc resets the received signal to its default action.
    struct sigaction action = {};
    sigaction(SIGTERM, nullptr, &action);
    kill(program, action.sa_handler == SIG_DFL ? SIGINT : SIGTERM);
  }

  std::string own_path()
  {
    return std::filesystem::read_symlink("/proc/self/exe").string();
  }

  int n_usable_cores()
  {
    cpu_set_t cores;
    CPU_ZERO(&cores);
    return sched_getaffinity(0, sizeof cores, &cores) == 0 ? CPU_COUNT(&cores) : 1;
  }
} // namespace diptych::coupling
