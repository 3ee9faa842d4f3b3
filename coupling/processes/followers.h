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
      prepare_grains,
      resume_grains, // from the checkpoint in the folder
      load_grains,
      run_continuum,
      run_next_continuum // beside an earlier one
    };

    explicit Followers(discrete::Processes &processes)
        : processes(processes)
    {}
    ~Followers()
    {
      if (!is_busy)
        (void)processes.of_first(end);
    }
    Followers(const Followers &)            = delete;
    Followers &operator=(const Followers &) = delete;

    // The others do it, too. What only this process throws ends the job, because they wait for it in the middle of the task.
    template <class Work> void share(const Task task, const Work &work)
    {
      (void)processes.of_first(task);
      is_busy = true;
      work();
      is_busy = false;
    }

    discrete::Processes &processes;

  private:
    bool is_busy = false;
  };

  // `followers`: null without an MPI job.
  inline int number_of_processes(const Followers *followers)
  {
    return followers ? followers->processes.size() : 1;
  }

  template <class Work> void share(Followers *followers, const Followers::Task task, const Work &work)
  {
    if (followers)
      followers->share(task, work);
    else
      work();
  }
} // namespace diptych::coupling
