// diptych: gmsh in a child process, so that a crash or an exit in gmsh does not end the run
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/mesh/mesh_child.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace diptych::continuum
{
  namespace
  {
    using Clock                               = std::chrono::steady_clock;
    constexpr int wall_seconds_per_cpu_second = 3; // the machine may be busy

    enum Answer : char
    {
      has_mesh,
      was_refused, // std::invalid_argument
      has_failed
    };

    template <class T> void put(std::string &bytes, const std::vector<T> &list)
    {
      const std::size_t n = list.size();
      bytes.append(reinterpret_cast<const char *>(&n), sizeof n);
      bytes.append(reinterpret_cast<const char *>(list.data()), n * sizeof(T));
    }

    template <class T> void take(const std::string &bytes, std::size_t &at, std::vector<T> &list)
    {
      std::size_t n = 0;
      std::memcpy(&n, bytes.data() + at, sizeof n);
      list.resize(n);
      std::memcpy(static_cast<void *>(list.data()), bytes.data() + at + sizeof n, n * sizeof(T));
      at += sizeof n + n * sizeof(T);
    }

    std::string answer_of(const std::function<QuadMesh()> &make)
    {
      try
        {
          const QuadMesh mesh = make();
          std::string    bytes(1, has_mesh);
          put(bytes, mesh.vertices);
          put(bytes, mesh.cells);
          put(bytes, mesh.boundary);
          return bytes;
        }
      catch (const std::invalid_argument &error)
        {
          return std::string(1, was_refused) + error.what();
        }
      catch (const std::exception &error)
        {
          return std::string(1, has_failed) + error.what();
        }
    }

    // Runs in the child process. The pipe closes when the child ends, whatever the reason.
    [[noreturn]] void answer_and_end(const std::function<QuadMesh()> &make, const int pipe, const unsigned int most_cpu_seconds)
    {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      for (const int signal : {SIGINT, SIGTERM, SIGXCPU, SIGSEGV, SIGABRT})
        std::signal(signal, SIG_DFL);
      setpgid(0, 0); // Ctrl-C goes to the parent only, which then ends the child
      const rlimit cpu = {most_cpu_seconds, most_cpu_seconds};
      if (most_cpu_seconds > 0)
        setrlimit(RLIMIT_CPU, &cpu);
      const rlimit nothing = {0, 0};
      setrlimit(RLIMIT_CORE, &nothing);
      setenv("HOME", "/dev/null", 1); // a library of gmsh would write settings there
      if (const int empty = open("/dev/null", O_RDONLY); empty >= 0)
        dup2(empty, STDIN_FILENO); // a script that asks a question gets no answer
      if (const int nowhere = open("/dev/null", O_WRONLY); nowhere >= 0)
        {
          dup2(nowhere, STDOUT_FILENO);
          dup2(nowhere, STDERR_FILENO);
        }
      const std::string bytes = answer_of(make);
      for (std::size_t done = 0; done < bytes.size();)
        {
          const ssize_t n = write(pipe, bytes.data() + done, bytes.size() - done);
          if (n < 0 && errno != EINTR)
            break;
          done += n > 0 ? std::size_t(n) : 0;
        }
      _exit(0);
    }

    // The child and the end of its pipe that is read. Leaving the scope kills a child that has not ended, and closes the pipe.
    struct Child
    {
      pid_t id; // negative: there is none
      int   pipe;

      ~Child()
      {
        if (id > 0)
          {
            kill(id, SIGKILL);
            (void)status();
          }
        close(pipe);
      }

      // Waits for its end. Call it once.
      int status()
      {
        int status = 0;
        while (waitpid(id, &status, 0) < 0 && errno == EINTR)
          {}
        id = 0;
        return status;
      }
    };

    QuadMesh mesh_of(const std::string &bytes, const int status, const unsigned int most_cpu_seconds)
    {
      if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL))
        throw GmshEnded("gmsh was ended: it needed more than " + std::to_string(most_cpu_seconds) +
                        " s of CPU time, three times as long by the clock, or more memory than there is");
      if (WIFSIGNALED(status))
        throw GmshEnded("gmsh was ended by signal " + std::to_string(WTERMSIG(status)));
      if (bytes.empty())
        throw GmshEnded("gmsh ended before there was a mesh");
      if (bytes[0] == was_refused)
        throw std::invalid_argument(bytes.substr(1));
      if (bytes[0] == has_failed)
        throw std::runtime_error(bytes.substr(1));
      QuadMesh    mesh;
      std::size_t at = 1;
      take(bytes, at, mesh.vertices);
      take(bytes, at, mesh.cells);
      take(bytes, at, mesh.boundary);
      return mesh;
    }
  } // namespace

  QuadMesh made_in_child(const std::function<QuadMesh()> &make, const CheckStop &check_stop, const unsigned int most_cpu_seconds)
  {
    constexpr int patience_ms = 50;
    int           ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0)
      throw std::runtime_error(std::string("no process for gmsh: ") + std::strerror(errno));
    Child child{fork(), ends[0]};
    if (child.id == 0)
      answer_and_end(make, ends[1], most_cpu_seconds);
    close(ends[1]);
    if (child.id < 0)
      throw std::runtime_error(std::string("no process for gmsh: ") + std::strerror(errno));
    const auto  last_moment = Clock::now() + wall_seconds_per_cpu_second * std::chrono::seconds(most_cpu_seconds);
    std::string bytes, piece(1 << 16, '\0');
    for (bool open = true; open;)
      {
        call(check_stop);
        if (most_cpu_seconds > 0 && Clock::now() > last_moment) // a script that sleeps uses no CPU time
          kill(child.id, SIGKILL);
        pollfd wait = {child.pipe, POLLIN, 0};
        if (poll(&wait, 1, patience_ms) <= 0)
          continue;
        const ssize_t n = read(child.pipe, piece.data(), piece.size());
        open            = n > 0 || (n < 0 && errno == EINTR);
        bytes.append(piece, 0, n > 0 ? std::size_t(n) : 0);
      }
    return mesh_of(bytes, child.status(), most_cpu_seconds);
  }
} // namespace diptych::continuum
