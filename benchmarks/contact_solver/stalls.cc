// diptych: how often sweeps stall on a few contacts in fast flow, and the cost
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cstdio>
#include <numeric>

#include "benchmarks/contact_solver/measuring.h"
#include "benchmarks/contact_solver/sections.h"
#include "benchmarks/contact_solver/sheared_states.h"

namespace diptych::benchmarks
{
  using namespace diptych::discrete;

  namespace
  {
    void print_steps(const int grains, const int n)
    {
      constexpr LoadCase load{"A at 1e-5", 1e-3, 0.02, 1e-5};
      Sheared            sheared         = start_shear(grains, load);
      sheared.setting.solver.max_sweeps  = 50000;
      sheared.setting.accept_unconverged = true;
      std::vector<double> sweeps;
      int                 relieved = 0, unsolved = 0;
      for (int k = 0; k < n; ++k)
        {
          const SolveReport report = discrete::advance(sheared.state, sheared.setting, sheared.cache).solve;
          sweeps.push_back(double(report.sweeps));
          relieved += report.relieved > 0;
          unsolved += report.status != SolveStatus::converged;
        }
      const Spread s = spread(sweeps);
      std::printf("%6d %6d %9.0f %8.0f %8.0f %10d %10d\n", grains, n, s.median,
                  std::accumulate(sweeps.begin(), sweeps.end(), 0.) / n, s.most, relieved, unsolved);
      std::fflush(stdout);
    }
  } // namespace

  void stalls(const std::string &)
  {
    std::printf("I = 1e-3, step 0.02, tolerance 1e-5, at most 50000 sweeps a step; ended with contacts swept by themselves; not "
                "converged\n");
    std::printf(" discs  steps   sweeps: median    mean     most   relieved   unsolved\n");
    print_steps(100, 3000);
    print_steps(1000, 500);
    print_steps(4000, 250);
  }
} // namespace diptych::benchmarks
