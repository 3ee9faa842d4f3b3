// diptych: value of the preceding step's impulses as a first guess
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
    double sweeps_from(const NextStep &next, std::vector<Impulse> guess, const double tolerance)
    {
      SolverOptions options;
      options.tolerance  = tolerance;
      options.max_sweeps = 100000;
      return double(solve(next.problem, options, guess).sweeps);
    }

    void print_moving(const std::string &states, const int grains, const LoadCase &load)
    {
      constexpr int n       = 11;
      Sheared       sheared = sheared_state(states, grains, load);
      for (const double tolerance : {1e-3, 1e-4, 1e-5})
        {
          Sheared             now = sheared;
          std::vector<double> warm, cold;
          for (int k = 0; k < n; ++k)
            {
              const NextStep next = next_step(now);
              warm.push_back(sweeps_from(next, next.guess, tolerance));
              cold.push_back(sweeps_from(next, std::vector<Impulse>(next.guess.size()), tolerance));
              (void)advance(now);
            }
          std::printf("%-6s %6d %8.0e %8.0f %8.0f %8.1f\n", load.name, grains, tolerance, spread(warm).median,
                      spread(cold).median, spread(cold).median / std::max(1., spread(warm).median));
        }
      std::fflush(stdout);
    }

    // A prepared sample with friction between platens at rest.
    void print_static(const int grains)
    {
      Sheared sheared = start_shear(grains, {"static", 0, 0.2, 1e-4});
      std::printf("static, %d discs, 1e-4: sweeps of steps 1, 2, ...:", grains);
      for (int k = 1; k <= 100; ++k)
        {
          const long sweeps = advance(sheared).solve.sweeps;
          if (k <= 10 || k % 10 == 0)
            std::printf(" %ld", sweeps);
        }
      std::printf(" (from the tenth on every tenth)\n");
    }
  } // namespace

  void warm_start(const std::string &states)
  {
    std::printf("median sweeps of 11 consecutive steps, from the preceding step's impulses and from zero\n");
    std::printf("state   discs tolerance   warm     cold  cold/warm\n");
    print_moving(states, 4000, state_a);
    print_moving(states, 4000, state_b);
    print_moving(states, 1000, rapid_flow);
    print_static(4000);
  }
} // namespace diptych::benchmarks
