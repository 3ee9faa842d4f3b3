// diptych: Ctrl-C (SIGINT), SIGTERM and a closed terminal (SIGHUP) end a run at its next step
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/processes/stop_signal.h"

#include <csignal>

#include <sys/prctl.h>
#include <unistd.h>

namespace diptych::coupling
{
  namespace
  {
    constexpr int stop_signals[] = {SIGINT, SIGTERM, SIGHUP};

    constexpr int all_signals[] = {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXFSZ};

    struct sigaction           at_second_interrupt = {}; // the system's: it kills
    volatile std::sig_atomic_t stop                = 0;
    volatile pid_t             parent              = 0; // 0: this process may outlive its parent
    volatile unsigned int      patience            = 0;

    // A handler may only use calls that are safe there.
    void request_stop(const int signal)
    {
      stop = 1;
      // A second Ctrl-C kills. SIGTERM may arrive several times for one reason: if a parent with several threads is killed,
      // each ending thread sends one. The checkpoint must still be written.
      if (signal == SIGINT)
        sigaction(signal, &at_second_interrupt, nullptr);
      if (parent != 0 && getppid() != parent)
        alarm(patience);
    }

    // SA_RESTART, because the standard library, HDF5 and MPI do not always check for EINTR. Inputs that could block forever,
    // such as a pipe or a device, are refused before they are opened (discrete::require_regular_file).
    void take(const int signal)
    {
      struct sigaction action = {};
      action.sa_handler       = request_stop;
      action.sa_flags         = SA_RESTART;
      sigemptyset(&action.sa_mask);
      sigaction(signal, &action, nullptr);
    }

    bool is_ignored(const int signal)
    {
      struct sigaction action = {};
      return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
    }

    sigset_t stop_set()
    {
      sigset_t set;
      sigemptyset(&set);
      for (const int signal : stop_signals)
        sigaddset(&set, signal);
      return set;
    }
  } // namespace

  void install_signals()
  {
    static const bool terminal_may_go = is_ignored(SIGHUP);
    take(SIGINT);
    take(SIGTERM);
    if (terminal_may_go)
      std::signal(SIGHUP, SIG_IGN);
    else
      take(SIGHUP);
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
    unblock_stop_signals();
  }

  TakenSignals::TakenSignals()
  {
    for (std::size_t k = 0; k < before.size(); ++k)
      sigaction(all_signals[k], nullptr, &before[k]);
    at_second_interrupt = before[0];
    install_signals();
  }

  TakenSignals::~TakenSignals()
  {
    for (std::size_t k = 0; k < before.size(); ++k)
      sigaction(all_signals[k], &before[k], nullptr);
    at_second_interrupt = {};
    stop                = 0;
  }

  bool stop_requested()
  {
    return stop != 0;
  }

  void block_stop_signals()
  {
    const sigset_t set = stop_set();
    sigprocmask(SIG_BLOCK, &set, nullptr);
  }

  void unblock_stop_signals()
  {
    const sigset_t set = stop_set();
    sigprocmask(SIG_UNBLOCK, &set, nullptr);
  }

  void end_after_parent(const unsigned int seconds)
  {
    patience = seconds;
    parent   = getppid();
    prctl(PR_SET_PDEATHSIG, SIGTERM);
  }

  void leave_if_stopped(const std::string &phase)
  {
    if (stop_requested())
      throw StoppedOnRequest(phase + ": stopped on request");
  }
} // namespace diptych::coupling
