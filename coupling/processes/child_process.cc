// diptych: programs run beside this one
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/processes/child_process.h"

#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include <fcntl.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace diptych::coupling
{
  namespace
  {
    bool belongs_to_mpi_job(const std::string &variable)
    {
      // Permission to run as root is the user's, not the job's.
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

    // After fork: only calls that are safe there. `log`: in the place of output and errors; -1: this process's own.
    [[noreturn]] void become(char *const *words, char *const *environment, const int log, const pid_t parent)
    {
      const int nothing = open("/dev/null", O_RDONLY);
      setpgid(0, 0);
      prctl(PR_SET_PDEATHSIG, SIGTERM);
      if (getppid() != parent) // it ended before it could be asked to tell
        _exit(127);
      dup2(nothing, STDIN_FILENO);
      if (log >= 0)
        {
          dup2(log, STDOUT_FILENO);
          dup2(log, STDERR_FILENO);
        }
      close_range(3, ~0U, 0); // sockets of an MPI job among them
      execve(words[0], words, environment);
      _exit(127);
    }

    pid_t launched(const std::vector<std::string> &words, const int log)
    {
      std::vector<std::string> arguments = words, variables;
      for (char **variable = environ; *variable != nullptr; ++variable)
        if (!belongs_to_mpi_job(*variable))
          variables.emplace_back(*variable);
      const std::vector<char *> argument_pointers = pointers(arguments), variable_pointers = pointers(variables);
      const pid_t               parent = getpid(), child = fork();
      if (child == 0)
        become(argument_pointers.data(), variable_pointers.data(), log, parent);
      if (child < 0)
        throw std::runtime_error("cannot start " + words[0] + ": " + std::strerror(errno));
      return child;
    }

    int code_of_status(const int status)
    {
      return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
    }
  } // namespace

  pid_t start_program(const std::vector<std::string> &words, const std::string &log)
  {
    const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (file < 0)
      throw std::runtime_error("cannot write " + log + ": " + std::strerror(errno));
    try
      {
        const pid_t child = launched(words, file);
        close(file);
        return child;
      }
    catch (const std::exception &)
      {
        close(file);
        throw;
      }
  }

  int run_program(const std::vector<std::string> &words)
  {
    const pid_t child  = launched(words, -1);
    int         status = 0;
    while (waitpid(child, &status, 0) < 0)
      if (errno != EINTR)
        throw std::runtime_error("process " + std::to_string(child) + " is lost: " + std::strerror(errno));
    return code_of_status(status);
  }

  std::optional<int> exit_code_of(const pid_t program)
  {
    int         status = 0;
    const pid_t ended  = waitpid(program, &status, WNOHANG);
    if (ended == 0 || (ended < 0 && errno == EINTR))
      return std::nullopt;
    if (ended < 0)
      throw std::runtime_error("process " + std::to_string(program) + " is lost: " + std::strerror(errno));
    return code_of_status(status);
  }

  void ask_to_stop(const pid_t program)
  {
    // The handler of stop_signal.cc gives the signal that came its default action back.
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
