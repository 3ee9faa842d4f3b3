// diptych: requests to stop a long computation between its phases
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

namespace diptych::continuum
{
  // Returns true if a stop was requested. The call is collective: all processes ask at the same places and get the same answer.
  // An empty function means that no stop can be requested.
  using StopRequest = std::function<bool()>;

  // The run was stopped before any state existed from which it could be resumed.
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
