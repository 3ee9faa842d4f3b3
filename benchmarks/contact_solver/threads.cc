// diptych: sweeps on two threads
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cstdio>
#include <cstring>

#include "benchmarks/contact_solver/measuring.h"
#include "benchmarks/contact_solver/sections.h"
#include "benchmarks/contact_solver/sheared_states.h"
#include "discrete/solvers/batched_sweep.h"

namespace diptych::benchmarks
{
  using namespace diptych::discrete;

  // One and two threads take turns, so that other programs on the machine disturb both in the same way. The least time has the
  // least disturbance. The solver does 20 sweeps between two checks.
  void threads(const std::string &states)
  {
    constexpr int repeats = 1000, n_sweeps = 20;
    const struct
    {
      int    grains;
      double target;
    } cases[] = {{4000, 1.7}, {16000, 1.9}};
    std::printf("state A, %d x %d sweeps, wall clock: least (median) microseconds a sweep\n", repeats, n_sweeps);
    std::printf(" discs blocks   one thread         two threads        speed-up  same bits  target\n");
    for (const auto &c : cases)
      {
        const NextStep      next = next_step(sheared_state(states, c.grains, state_a));
        ThreadTeam          one(1), two(2);
        BatchedContacts     a(next.problem), b(next.problem);
        std::vector<double> seconds_one, seconds_two;
        a.set_impulses(next.guess), b.set_impulses(next.guess);
        for (int k = 0; k < repeats; ++k)
          {
            seconds_one.push_back(timed(1, wall_seconds, [&] { a.sweep(1.8, 1.0, n_sweeps, one); }).median);
            seconds_two.push_back(timed(1, wall_seconds, [&] { b.sweep(1.8, 1.0, n_sweeps, two); }).median);
          }
        const std::vector<Impulse> ra = a.impulses(), rb = b.impulses();
        const bool                 same = std::memcmp(ra.data(), rb.data(), ra.size() * sizeof(Impulse)) == 0 &&
                          a.residual(one) == b.residual(two);
        const Spread alone = spread(seconds_one), both = spread(seconds_two);
        const double speedup = alone.least / both.least, us = 1e6 / n_sweeps;
        std::printf("%6d %6zu %8.1f (%6.1f) %8.1f (%6.1f)  %5.2f (%4.2f) %-8s %.1f %s\n", c.grains, a.n_blocks(),
                    us * alone.least, us * alone.median, us * both.least, us * both.median, speedup, alone.median / both.median,
                    same ? "yes" : "NO", c.target, speedup >= c.target ? "met" : "NOT MET");
      }
  }
} // namespace diptych::benchmarks
