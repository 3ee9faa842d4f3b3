// diptych: the processes of an MPI job that sweep the grains of the first one
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "discrete/solvers/processes.h"

namespace diptych::coupling
{
  // The first process runs the command and owns all files. The others wait for what it starts, compute the same and write
  // nothing.
  class Followers
  {
  public:
    enum Task
    {
      end,
      grains,
      rest_of_grains, // from the checkpoint in the folder
      continuum,
      next_continuum // beside an earlier one
    };

    explicit Followers(discrete::Processes &processes)
        : processes(processes)
    {}
    ~Followers() { start(end); }
    Followers(const Followers &)            = delete;
    Followers &operator=(const Followers &) = delete;

    void start(const Task task) { (void)processes.of_first(task); }

    discrete::Processes &processes;
  };
} // namespace diptych::coupling
