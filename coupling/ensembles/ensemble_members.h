// diptych: the members of an ensemble, run side by side
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

namespace diptych::coupling
{
  struct MemberRuns
  {
    std::vector<std::string> command; // program, `run`, scene and options that all members share
    std::string              directory;
    std::vector<int>         seeds; // to run
    int                      n_finished_before = 0;
    int                      jobs              = 1; // at once, on each process
    bool                     quiet             = false;
  };

  struct MemberOutcome
  {
    int  seed        = 0;
    int  exit_code   = 0;
    bool interrupted = false; // it was asked to stop, or never begun
  };

  // Each seed is a run of the program on its own, in DIR/seed_K, its output in DIR/seed_K.log. Under mpirun process r of n takes
  // every n-th seed. On a stop signal the members that run are asked to write their checkpoints, and no other one begins.
  // Collective. Returns, on the first process alone, one outcome a seed, by seed.
  std::vector<MemberOutcome> run_members(const MemberRuns &runs);
} // namespace diptych::coupling
