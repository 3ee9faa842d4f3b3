// diptych: steps with implicit compliant contacts: sweeps and seconds against stiffness, tolerance and size
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cstdio>

#include "benchmarks/contact_solver/measuring.h"
#include "benchmarks/contact_solver/sections.h"
#include "benchmarks/contact_solver/sheared_states.h"

namespace diptych::benchmarks
{
  using namespace diptych::discrete;

  namespace
  {
    void print_steps(Sheared sheared, const char *state, const double stiffness, const double tolerance)
    {
      constexpr int n                   = 11;
      sheared.setting.compliance        = {stiffness, 0.2};
      sheared.setting.solver.max_sweeps = 20000;
      std::vector<double> seconds, sweeps, residuals;
      int                 converged = 0;
      for (int step = 0; step < 2 * n; ++step)
        {
          sheared.setting.accept_unconverged = true;
          sheared.setting.solver.tolerance   = step < n ? 1e-4 : tolerance; // the first steps load the springs
          const double     begin             = cpu_seconds();
          const StepResult result            = discrete::advance(sheared.state, sheared.setting, sheared.cache);
          if (step < n)
            continue;
          seconds.push_back(cpu_seconds() - begin);
          sweeps.push_back(double(result.solve.sweeps));
          residuals.push_back(result.solve.residual);
          converged += result.solve.status == SolveStatus::converged;
        }
      const Spread s = spread(seconds), w = spread(sweeps);
      std::printf("%6zu %-5s %6.0e %9.0e      %2d of %d   %8.1e   %6.0f %6.0f %6.0f   %7.3f %7.3f %7.3f\n",
                  sheared.state.grains.size(), state, stiffness, tolerance, converged, n, spread(residuals).most, w.least,
                  w.median, w.most, s.least, s.median, s.most);
      std::fflush(stdout);
    }
  } // namespace

  void compliant(const std::string &states)
  {
    std::printf("11 steps after 11 that load the springs, warm start, CPU time of the whole step; sweeps and seconds: least, "
                "median, most\n discs state  kn/P tolerance  converged   residual   sweeps                 seconds\n");
    for (const int grains : {4000, 16000})
      for (const LoadCase &load : {state_a, state_b})
        {
          const Sheared sheared = sheared_state(states, grains, load);
          for (const double stiffness : {1e4, 1e5})
            for (const double tolerance : {1e-4, 1e-6, 1e-8})
              print_steps(sheared, load.name, stiffness, tolerance);
        }
  }
} // namespace diptych::benchmarks
