// diptych: Ctrl-C (SIGINT), SIGTERM and a closed terminal (SIGHUP) end a run at its next step
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <csignal>
#include <stdexcept>
#include <string>

namespace diptych::coupling
{
  // Installs handlers for the three signals. They also receive signals that have waited since block_stop_signals(), even if
  // this was called before exec. Call it first in main, and again after libraries that change handlers, such as MPI_Init. A
  // second Ctrl-C kills. SIGHUP stays ignored if it was (nohup). SIGPIPE is ignored, because a closed output pipe must not stop
  // a run. SIGXFSZ too: a file size limit is reported like a full disk.
  void install_signals();
  bool stop_requested();

  // install_signals() while it lives; then the handlers of before are back, and no request is left. For a process that goes on.
  class TakenSignals
  {
  public:
    TakenSignals();
    TakenSignals(const TakenSignals &)            = delete;
    TakenSignals &operator=(const TakenSignals &) = delete;
    ~TakenSignals();

  private:
    std::array<struct sigaction, 5> before;
  };

  // Makes signals wait until install_signals(), also across exec. Otherwise they would kill a program that has just started.
  void block_stop_signals();
  void unblock_stop_signals();

  // This process receives SIGTERM when its parent dies. It then has `seconds` to end before SIGALRM kills it.
  void end_after_parent(unsigned int seconds);

  // A stop signal ended the work: exit code 3. The hooks of the panels also throw it.
  struct StoppedOnRequest : std::runtime_error
  {
    using std::runtime_error::runtime_error;
  };
  void leave_if_stopped(const std::string &phase); // throws "PHASE: stopped on request"
} // namespace diptych::coupling
