// diptych: what is asked between the phases of what takes long
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

namespace diptych::continuum
{
  // True: somebody asked to stop. Collective: on several processes all ask at the same places and get the same answer. Empty:
  // nobody asks.
  using StopRequest = std::function<bool()>;

  // Before there is anything to go on from.
  struct SetUpStopped : std::runtime_error
  {
    using std::runtime_error::runtime_error;
  };

  inline void leave_if(const StopRequest &stop_requested, const std::string &phase)
  {
    if (stop_requested && stop_requested())
      throw SetUpStopped("stopped on request before " + phase);
  }
} // namespace diptych::continuum
