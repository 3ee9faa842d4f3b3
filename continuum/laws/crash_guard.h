// diptych: survives a crash inside a call of a user's library
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <csetjmp>

namespace diptych::continuum
{
  // Takes over SIGSEGV, SIGBUS, SIGFPE, SIGILL and SIGABRT. Outside guarded() the earlier actions still apply. A second call does
  // nothing.
  void install_crash_guard();

  // Where a crash on this thread goes; nullptr: nowhere.
  extern thread_local sigjmp_buf *crash_exit;

  void        unblock_crash(int signal); // the handler left by a jump, so its signal is still blocked
  const char *name_of_crash(int signal); // "SIGSEGV (invalid memory)"

  // Runs `call`, which must not own anything. Returns the signal of a crash in it, or 0. Needs install_crash_guard().
  template <class Call> int guarded(Call &&call)
  {
    sigjmp_buf exit;
    const int  signal = sigsetjmp(exit, 0); // 0: saving the mask of signals would cost a system call
    if (signal == 0)
      {
        crash_exit = &exit;
        call();
      }
    else
      unblock_crash(signal);
    crash_exit = nullptr;
    return signal;
  }
} // namespace diptych::continuum
