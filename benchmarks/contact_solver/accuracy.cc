// diptych: error of the grain stress for a given residual
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cstdio>
#include <limits>

#include "benchmarks/contact_solver/measuring.h"
#include "benchmarks/contact_solver/sections.h"
#include "benchmarks/contact_solver/sheared_states.h"
#include "discrete/stepping/grain_stress_error.h"

namespace diptych::benchmarks
{
  using namespace diptych::discrete;

  namespace
  {
    // The check at which the residual first fell below `wanted`.
    struct Instant
    {
      double               wanted, residual, change, estimate;
      long                 sweeps;
      std::vector<Impulse> impulses;
    };

    // One solve to 1e-9, or to the end of its budget of sweeps, observed on the way.
    std::vector<Instant> watch(const NextStep &next, const long budget, std::vector<Impulse> &r, SolveReport &report)
    {
      std::vector<double>  wanted{1e-3, 1e-4, 1e-5, 1e-6, 1e-7};
      std::vector<Instant> instants;
      GrainStressError     error;
      ThreadTeam           alone(1);
      SolverOptions        options;
      options.tolerance   = std::numeric_limits<double>::max(); // The condition below is evaluated at every check.
      options.max_sweeps  = int(budget);
      r                   = next.guess;
      const StopTest look = [&](const SolveReport &now, const std::function<std::vector<Impulse>()> &present) {
        if (error.wants(now.sweeps))
          error.observe(contact_moments(next.radius, next.contacts, present()));
        while (!wanted.empty() && now.residual <= wanted.front())
          {
            instants.push_back({wanted.front(), now.residual, error.change(), error.estimate(), now.sweeps, present()});
            wanted.erase(wanted.begin());
          }
        return now.residual <= 1e-9;
      };
      report = solve(next.problem, options, r, alone, look);
      return instants;
    }

    void print_errors(const std::string &states, const int grains, const LoadCase &load)
    {
      constexpr long             budget = 1000000;
      const NextStep             next   = next_step(sheared_state(states, grains, load));
      std::vector<Impulse>       exact;
      SolveReport                report;
      const std::vector<Instant> instants = watch(next, budget, exact, report);
      std::printf("%d discs, state %s: reference residual %.1e after %ld sweeps; first guess in error by %.3f\n", grains,
                  load.name, report.residual, report.sweeps, stress_difference(next, next.guess, exact));
      for (const Instant &i : instants)
        std::printf("  %8.0e %10.2e %8ld %10.5f %10.5f %10.5f\n", i.wanted, i.residual, i.sweeps,
                    stress_difference(next, i.impulses, exact), i.change, i.estimate);
      std::fflush(stdout);
    }
  } // namespace

  void accuracy(const std::string &states)
  {
    std::printf(
      "rms error of grain stress / rms grain stress where the residual first is below each value: true; its change in the "
      "last doubling of the sweeps; GrainStressError's estimate (inf: unknown)\n"
      "  residual    reached   sweeps       true     change  estimated\n");
    for (const int grains : {1000, 4000})
      for (const LoadCase &load : {state_a, state_b})
        print_errors(states, grains, load);
  }
} // namespace diptych::benchmarks
