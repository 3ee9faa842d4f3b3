// diptych: no signal is lost or kills during start-up, and no worker outlives its parent for long
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <csignal>

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "coupling/processes/stop_signal.h"
#include "tests/common.h"

namespace
{
  using namespace diptych::coupling;

  // Status from waitpid() of a copy of this process that runs `work` and exits with its result.
  template <class Work> int status_of_copy(const Work &work)
  {
    const pid_t copy = fork();
    if (copy == 0)
      _exit(work());
    int status = 0;
    waitpid(copy, &status, 0);
    return status;
  }

  // A signal between block and install does not kill and counts as a stop request. Without blocking it would kill the copy
  // (SIGTERM is 15).
  TEST(StopSignal, ASignalBeforeTheHandlersIsKept)
  {
    for (const int signal : {SIGTERM, SIGINT, SIGHUP})
      {
        const int status = status_of_copy([signal] {
          std::signal(signal, SIG_DFL);
          block_stop_signals();
          raise(signal);
          const bool early = stop_requested();
          install_signals();
          return !early && stop_requested() ? 7 : 8;
        });
        ASSERT_TRUE(WIFEXITED(status)) << "ended by signal " << WTERMSIG(status);
        EXPECT_EQ(WEXITSTATUS(status), 7);
      }
  }

  TEST(StopSignal, AHangupThatIsIgnoredStaysIgnored)
  {
    const int status = status_of_copy([] {
      std::signal(SIGHUP, SIG_IGN);
      install_signals();
      raise(SIGHUP);
      return stop_requested() ? 8 : 7;
    });
    EXPECT_EQ(WEXITSTATUS(status), 7);
  }

  // MPI_Init resets some signals to their default actions, which would kill the program.
  TEST(StopSignal, IgnoredSignalsStayIgnoredAfterMpi)
  {
    const int status = status_of_copy([] {
      std::signal(SIGHUP, SIG_IGN);
      install_signals();
      for (const int signal : {SIGHUP, SIGPIPE, SIGXFSZ})
        std::signal(signal, SIG_DFL);
      install_signals();
      for (const int signal : {SIGHUP, SIGPIPE, SIGXFSZ})
        raise(signal);
      return stop_requested() ? 8 : 7;
    });
    ASSERT_TRUE(WIFEXITED(status)) << "ended by signal " << WTERMSIG(status);
    EXPECT_EQ(WEXITSTATUS(status), 7);
  }

  // A worker that never checks for a stop request. The parent ends once the worker is ready. Only the worker then holds the
  // pipe, which closes when it ends. If it did not end, the test would hang.
  TEST(StopSignal, AWorkerEndsAfterItsParent)
  {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    const int status = status_of_copy([&] {
      const pid_t parent = getpid();
      if (fork() == 0)
        {
          prctl(PR_SET_PDEATHSIG, SIGTERM);
          install_signals();
          end_after_parent(1);
          if (getppid() != parent || write(ends[1], "r", 1) != 1)
            _exit(1);
          for (;;)
            pause();
        }
      char ready = 0;
      return read(ends[0], &ready, 1) == 1 ? 7 : 8;
    });
    ASSERT_EQ(WEXITSTATUS(status), 7);
    close(ends[1]);
    char more = 0;
    EXPECT_EQ(read(ends[0], &more, 1), 0);
    close(ends[0]);
  }
} // namespace
