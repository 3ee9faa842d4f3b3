// diptych: how a caller stops a long computation
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>

namespace diptych::continuum
{
  // Called by work that can be continued. True: stop and report. Collective: all processes call it at the same places and get
  // the same answer. Empty: never stops.
  using StopRequest = std::function<bool()>;

  // Called regularly by work that leaves nothing to continue. It may throw to stop; the exception passes to the caller. Empty:
  // never stops.
  using CheckStop = std::function<void()>;

  inline void call(const CheckStop &check_stop)
  {
    if (check_stop)
      check_stop();
  }
} // namespace diptych::continuum
