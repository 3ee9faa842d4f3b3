// diptych: survives a crash inside a call of a user's library
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/crash_guard.h"

#include <csignal>

namespace diptych::continuum
{
  thread_local sigjmp_buf *crash_exit = nullptr;

  namespace
  {
    constexpr int crashes[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};

    struct sigaction earlier[NSIG];
    char             stack[1 << 16]; // a recursion without end leaves none of the usual one

    // Without a guarded call the earlier action takes over: a fault happens again, abort() raises its signal again.
    void leave(const int signal)
    {
      if (crash_exit != nullptr)
        siglongjmp(*crash_exit, signal);
      sigaction(signal, &earlier[signal], nullptr);
    }
  } // namespace

  void install_crash_guard()
  {
    static const bool is_installed = [] {
      stack_t other = {};
      other.ss_sp   = stack;
      other.ss_size = sizeof stack;
      sigaltstack(&other, nullptr);
      struct sigaction action = {};
      action.sa_handler       = leave;
      action.sa_flags         = SA_ONSTACK;
      sigemptyset(&action.sa_mask);
      for (const int signal : crashes)
        sigaction(signal, &action, &earlier[signal]);
      return true;
    }();
    (void)is_installed;
  }

  void unblock_crash(const int signal)
  {
    sigset_t set;
    sigemptyset(&set);
    sigaddset(&set, signal);
    pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
  }

  const char *name_of_crash(const int signal)
  {
    switch (signal)
      {
      case SIGSEGV:
        return "SIGSEGV (invalid memory)";
      case SIGBUS:
        return "SIGBUS (invalid memory)";
      case SIGFPE:
        return "SIGFPE (a whole number divided by zero)";
      case SIGILL:
        return "SIGILL (an unknown machine instruction)";
      default:
        return "SIGABRT (abort, assert or a damaged heap)";
      }
  }
} // namespace diptych::continuum
