// diptych: several processes that run the continuum together
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <exception>
#include <functional>

namespace diptych::coupling
{
  // All need an initialised MPI and are collective, but for is_first_process() and n_processes().
  bool         is_first_process();
  unsigned int n_processes();

  // Runs `work` on the first process alone: files, grains and messages are its affair. Everyone returns its value, or throws
  // what it threw, so that none waits for another.
  int on_first_process(const std::function<int()> &work);

  double sum_over_processes(double value);
  double from_first_process(double value); // everyone gets the first one's

  // Runs `work` and returns its exit code. An exception is told on standard error and becomes an exit code: once where all
  // processes meet the same one. One that some processes do not share ends all of them (MPI_Abort): they would wait for ever.
  int               answer_for(const std::function<int()> &work);
  [[nodiscard]] int code_of(const std::exception &error);
} // namespace diptych::coupling
