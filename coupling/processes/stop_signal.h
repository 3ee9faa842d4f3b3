// diptych: Ctrl-C, SIGTERM and a terminal that goes (SIGHUP) end the run at the next step
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <stdexcept>
#include <string>

namespace diptych::coupling
{
  // Takes the three signals from now on, those that wait behind block_stop_signals() or the same of the program before this one
  // among them. To be called first of all in main, and again behind what takes signals to itself, as MPI's beginning does. A
  // second Ctrl-C kills as usual. SIGHUP stays ignored where it was (nohup). SIGPIPE and SIGXFSZ are: the results do not care
  // whether somebody still reads what is said, and a limit of file sizes is told as a full disk is.
  void install_signals();
  bool stop_requested();

  // They wait, over exec too, until install_signals(): a program that has just begun would die of them.
  void block_stop_signals();
  void unblock_stop_signals();

  // Of a process whose parent's death sends it SIGTERM (start_answerer): it then has `seconds` to end, and is ended by SIGALRM.
  void end_after_parent(unsigned int seconds);

  // Work was left on request: exit code 3. The hooks of the panels throw it, too.
  struct StoppedOnRequest : std::runtime_error
  {
    using std::runtime_error::runtime_error;
  };
  void leave_if_stopped(const std::string &phase); // throws it: "PHASE: stopped on request"
} // namespace diptych::coupling
