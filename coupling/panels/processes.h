// diptych: helpers for several MPI processes that run one scene together
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <exception>
#include <functional>
#include <string>
#include <vector>

#include "discrete/solvers/processes.h"

namespace diptych::coupling
{
  // Call before MPI is initialised. A process that was not started by mpirun needs no MPI daemon. The daemon requires PATH, ssh
  // and files in TMPDIR, and ends the process if one is missing.
  void avoid_mpi_daemon();

  // All functions need an initialised MPI. All except the next three are collective.
  bool         is_first_process();
  unsigned int n_processes();

  // For MPI_Abort, which ML calls if memory is short, and which would end the process without a message. A single process goes on
  // as from what any library throws; of several all end with this exit code.
  [[noreturn]] void leave_for_mpi_abort(int code);

  // Runs `work`, which reads and writes files, on the first process only. All processes return its value or throw its
  // exception, so that none waits for another.
  int on_first_process(const std::function<int()> &work);

  double              sum_over_processes(double value);
  double              from_first_process(double value); // all return the value of the first process
  std::vector<double> from_first_process(std::vector<double> values);

  // All processes of the job, for the grains.
  discrete::Processes &mpi_processes();

  bool any_process(bool value); // true if the value is true on any process

  // Runs `work` and returns its exit code. An exception is printed to standard error, and `code_of` gives its exit code. If all
  // processes throw, the message is printed once. If only some throw, MPI_Abort ends all, because the others would wait forever.
  int run_and_report(const std::function<int()> &work,
                     int (*code_of)(const std::exception &),
                     std::string (*text_of)(const std::exception &));
} // namespace diptych::coupling
