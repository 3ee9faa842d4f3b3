// diptych: how a caller stops a long computation
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>

namespace diptych::continuum
{
  // Work that can be continued asks this and ends with a report. True: stop. Collective: on several processes all ask at the
  // same places and get the same answer. Empty: never stops.
  using StopRequest = std::function<bool()>;

  // Work that leaves nothing to continue calls this now and then. It may throw to leave; the exception passes to the caller.
  // Empty: never stops.
  using CheckStop = std::function<void()>;

  inline void call(const CheckStop &check_stop)
  {
    if (check_stop)
      check_stop();
  }
} // namespace diptych::continuum
