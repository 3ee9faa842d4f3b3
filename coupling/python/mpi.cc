// diptych: MPI in a Python process
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/python/mpi.h"

#include <csignal>
#include <memory>

#include <deal.II/base/mpi.h>
#include <deal.II/base/multithread_info.h>
#include <sc.h>

#include "coupling/panels/processes.h"
#include "coupling/program/exit_code.h"

// Exported, so that the libraries that this module loads call it.
extern "C" __attribute__((visibility("default"))) int MPI_Abort(MPI_Comm, int)
{
  diptych::coupling::leave_for_mpi_abort(diptych::coupling::system_failure);
}

namespace diptych::python
{
  namespace
  {
    std::unique_ptr<dealii::Utilities::MPI::MPI_InitFinalize> own_mpi;

    bool has_started()
    {
      int started = 0;
      MPI_Initialized(&started);
      return started != 0;
    }
  } // namespace

  void start_mpi()
  {
    if (has_started())
      {
        dealii::MultithreadInfo::set_thread_limit(1);        // as MPI_InitFinalize; more threads would not change results
        sc_set_log_defaults(nullptr, nullptr, SC_LP_SILENT); // as MPI_InitFinalize; otherwise p4est prints a line per mesh
        return;
      }
    coupling::avoid_mpi_daemon();
    struct sigaction interrupt, end;
    sigaction(SIGINT, nullptr, &interrupt);
    sigaction(SIGTERM, nullptr, &end);
    int    n_words = 0;
    char **words   = nullptr;
    own_mpi        = std::make_unique<dealii::Utilities::MPI::MPI_InitFinalize>(n_words, words, 1);
    sigaction(SIGINT, &interrupt, nullptr);
    sigaction(SIGTERM, &end, nullptr);
  }

  void end_mpi()
  {
    own_mpi.reset();
  }
} // namespace diptych::python
