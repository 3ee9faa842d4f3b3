// diptych: Ctrl-C and SIGTERM end the run at the next step
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <stdexcept>
#include <string>

namespace diptych::coupling
{
  void install_stop_signals(); // a second Ctrl-C kills as usual
  bool stop_requested();

  // A phase that has nothing to go on from was asked to end: exit code 3.
  struct StoppedOnRequest : std::runtime_error
  {
    using std::runtime_error::runtime_error;
  };
  void leave_if_stopped(const std::string &phase); // throws it: "PHASE: stopped on request"
} // namespace diptych::coupling
