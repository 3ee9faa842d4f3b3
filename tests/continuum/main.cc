// diptych: main function of the continuum panel's tests, on one process or several
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/mpi.h>

#include "tests/common.h"

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
#endif

namespace
{
  // The leak checker ignores what MPI allocates at its start and checks the rest before MPI ends. MPI then closes its plugins,
  // and their memory would be reported as lost.
  int run_between(int &argc, char **&argv)
  {
#ifdef __SANITIZE_ADDRESS__
    __lsan_disable();
    dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
    __lsan_enable();
    const int result = RUN_ALL_TESTS();
    __lsan_do_leak_check();
    return result;
#else
    dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
    return RUN_ALL_TESTS();
#endif
  }
} // namespace

int main(int argc, char **argv)
{
  testing::InitGoogleTest(&argc, argv);
  return run_between(argc, argv);
}
