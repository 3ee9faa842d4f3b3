// diptych: several processes that run the continuum together
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <exception>
#include <functional>
#include <string>
#include <vector>

namespace diptych::coupling
{
  // Before MPI is initialised: a process that was not started as one of several needs no daemon of MPI beside it, which asks for
  // a PATH, for ssh, for files in TMPDIR, and ends the process where one is missing.
  void need_no_daemon();

  // All need an initialised MPI and are collective, but for the next three.
  bool         is_first_process();
  unsigned int n_processes();
  unsigned int own_number(); // of this process, from 0

  // Runs `work` on the first process alone: files, grains and messages are its affair. Everyone returns its value, or throws
  // what it threw, so that none waits for another.
  int on_first_process(const std::function<int()> &work);

  double              sum_over_processes(double value);
  double              from_first_process(double value); // everyone gets the first one's
  std::vector<double> from_first_process(std::vector<double> values);

  bool any_process(bool value); // whether it is true on one of them

  // Runs `work` and returns its exit code. An exception is told on standard error and becomes what `code_of` makes of it: once
  // where all processes meet the same one. One that some processes do not share ends all of them (MPI_Abort): they would wait for
  // ever.
  int answer_for(const std::function<int()> &work,
                 int (*code_of)(const std::exception &),
                 std::string (*text_of)(const std::exception &));
} // namespace diptych::coupling
