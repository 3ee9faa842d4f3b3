// diptych: behaviour of the sweeps in a step that does not converge
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>
#include <cstdio>

#include "benchmarks/contact_solver/measuring.h"
#include "benchmarks/contact_solver/sections.h"
#include "benchmarks/contact_solver/sheared_states.h"
#include "discrete/solvers/batched_sweep.h"

namespace diptych::benchmarks
{
  using namespace diptych::discrete;

  namespace
  {
    constexpr int  records = 31;
    constexpr long before = 50000, apart = 2000; // sweeps

    struct Wandering
    {
      double              mean_residual = 0, least_residual = 1; // The mean is geometric.
      std::vector<double> change;                                // Rms relative change of grain stress since the first record.
    };

    Wandering watch(const NextStep &next, const double omega)
    {
      constexpr int   over_relaxed = 90, plain = 10;
      ThreadTeam      alone(1);
      BatchedContacts batches(next.problem);
      const auto      sweep = [&](const long n) {
        for (long k = 0; k < n; k += over_relaxed + plain)
          batches.sweep(omega, 1, over_relaxed, alone), batches.sweep(1, 1, plain, alone);
        batches.refresh_velocities();
      };
      batches.set_impulses(next.guess);
      sweep(before);
      const std::vector<Impulse> first = batches.impulses();
      Wandering                  seen;
      for (int k = 0; k < records; ++k, sweep(apart))
        {
          const double residual = batches.residual(alone);
          seen.mean_residual += std::log(residual) / records;
          seen.least_residual = std::min(seen.least_residual, residual);
          seen.change.push_back(stress_difference(next, batches.impulses(), first));
        }
      seen.mean_residual = std::exp(seen.mean_residual);
      return seen;
    }
  } // namespace

  void wandering(const std::string &states)
  {
    constexpr int n_steps = 6, steps_apart = 2;
    std::printf(
      "4000 discs, state B, %d steps, every second one; residual over sweeps %ld to %ld (every %ld), and rms change of grain "
      "stress since sweep %ld; medians over the steps\n",
      n_steps, before, before + (records - 1) * apart, apart, before);
    std::printf("omega   residual: least  geometric mean   change after %ld, %ld, %ld, %ld sweeps\n", apart, 5 * apart,
                15 * apart, 30 * apart);
    for (const double omega : {1.8, 1.5, 1.2})
      {
        Sheared             sheared = sheared_state(states, 4000, state_b);
        std::vector<double> least, mean, change[4];
        for (int step = 0; step < n_steps; ++step)
          {
            const Wandering seen = watch(next_step(sheared), omega);
            least.push_back(seen.least_residual), mean.push_back(seen.mean_residual);
            for (int k = 0; k < 4; ++k)
              change[k].push_back(seen.change[std::vector<int>{1, 5, 15, 30}[k]]);
            for (int k = 0; k < steps_apart; ++k)
              (void)advance(sheared);
          }
        std::printf("%5.1f  %14.1e %15.1e        %7.3f %7.3f %7.3f %7.3f\n", omega, spread(least).median, spread(mean).median,
                    spread(change[0]).median, spread(change[1]).median, spread(change[2]).median, spread(change[3]).median);
        std::fflush(stdout);
      }
  }
} // namespace diptych::benchmarks
