// diptych: Ctrl-C, SIGTERM and a terminal that goes (SIGHUP) end the run at the next step
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/processes/stop_signal.h"

#include <csignal>

namespace diptych::coupling
{
  namespace
  {
    volatile std::sig_atomic_t stop = 0;

    void request_stop(const int signal)
    {
      stop = 1;
      // A second Ctrl-C kills. SIGTERM may come several times for one reason: from a parent with several threads that is killed,
      // once for each that ends after the one before, and the checkpoint must be written all the same.
      if (signal == SIGINT)
        std::signal(signal, SIG_DFL);
    }
  } // namespace

  void install_stop_signals()
  {
    std::signal(SIGINT, request_stop);
    std::signal(SIGTERM, request_stop);
    if (std::signal(SIGHUP, request_stop) == SIG_IGN) // nohup: the terminal may go
      std::signal(SIGHUP, SIG_IGN);
  }

  bool stop_requested()
  {
    return stop != 0;
  }

  void leave_if_stopped(const std::string &phase)
  {
    if (stop_requested())
      throw StoppedOnRequest(phase + ": stopped on request");
  }
} // namespace diptych::coupling
