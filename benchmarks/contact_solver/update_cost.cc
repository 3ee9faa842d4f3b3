// diptych: cost of one contact update, sweeps only
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cstdio>

#include "benchmarks/contact_solver/measuring.h"
#include "benchmarks/contact_solver/sections.h"
#include "benchmarks/contact_solver/sheared_states.h"
#include "discrete/contacts/contact_law.h"
#include "discrete/contacts/natural_map.h"
#include "discrete/solvers/batched_sweep.h"
#include "discrete/solvers/solver.h"
#include "discrete/solvers/sweeps.h"

namespace diptych::benchmarks
{
  using namespace diptych::discrete;

  // The contacts of a problem with a rolling resistance of 0.1 between discs of equal size.
  ContactProblem with_rolling(ContactProblem problem)
  {
    for (ContactRow &c : problem.contacts)
      set_rolling(0.2, 0.5, c);
    return problem;
  }

  // Every contact of the problem, open or closed, is one update per sweep.
  void update_cost(const std::string &states)
  {
    constexpr int       n_sweeps = 200, repeats = 15;
    const NextStep      next = next_step(sheared_state(states, 4000, state_a));
    const SolverOptions o;
    BatchedContacts     batches(next.problem, {}, next.guess);
    ThreadTeam          alone(1);

    std::vector<Impulse>      r     = next.guess;
    std::vector<BodyVelocity> v     = velocities(next.problem, r);
    const Spread              plain = timed(repeats, cpu_seconds, [&] {
      for (int k = 0; k < n_sweeps; ++k)
        sweep_nsgs(next.problem, v, r);
    });
    r = next.guess, v = velocities(next.problem, r);
    const std::vector<int> order  = batches.order();
    const Spread           scalar = timed(repeats, cpu_seconds, [&] {
      for (int k = 0; k < n_sweeps; ++k)
        sweep_psor(next.problem, order, o.omega_sticking, o.omega_slipping, v, r);
    });
    batches.set_impulses(next.guess);
    const Spread         batched = timed(repeats, cpu_seconds,
                                         [&] { batches.sweep(o.omega_sticking, o.omega_slipping, n_sweeps, alone); });
    const ContactProblem rolling = with_rolling(next.problem);
    BatchedContacts      turning(rolling, {}, next.guess);
    turning.set_impulses(next.guess);
    const Spread couples  = timed(repeats, cpu_seconds,
                                  [&] { turning.sweep(o.omega_sticking, o.omega_slipping, n_sweeps, alone); });
    double       sum      = 0; // Used, so that the compiler cannot remove the residual.
    const Spread residual = timed(repeats, cpu_seconds, [&] {
      for (int k = 0; k < n_sweeps; ++k)
        sum += batches.residual(alone);
    });

    const double n = double(next.contacts.size()) * n_sweeps;
    std::printf("%zu contacts, %zu batches in %zu blocks; median (least) of %d x %d sweeps, CPU time; residual %.1e\n",
                next.contacts.size(), batches.n_batches(), batches.n_blocks(), repeats, n_sweeps, sum / (repeats * n_sweeps));
    const auto row = [&](const char *name, const Spread &s) {
      std::printf("%-36s %6.2f (%5.2f) ns per update, %.2f of the plain sweep\n", name, 1e9 * s.median / n, 1e9 * s.least / n,
                  s.median / plain.median);
    };
    row("plain scalar sweep, sweep order", plain);
    row("scalar psor, order of the batches", scalar);
    row("batched psor", batched);
    row("batched psor, rolling resistance", couples);
    row("batched residual (not an update)", residual);
    std::printf("target: batched psor <= 6 ns: %s\n", 1e9 * batched.median / n <= 6 ? "met" : "NOT MET");
  }
} // namespace diptych::benchmarks
