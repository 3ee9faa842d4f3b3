// diptych: gain from the order of the sweeps when omega depends on the contact status
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cstdio>
#include <numeric>
#include <random>

#include "benchmarks/contact_solver/measuring.h"
#include "benchmarks/contact_solver/sections.h"
#include "benchmarks/contact_solver/sheared_states.h"

namespace diptych::benchmarks
{
  using namespace diptych::discrete;

  namespace
  {
    struct Relaxation
    {
      const char *name;
      double      sticking, slipping;
    };
    constexpr Relaxation  relaxations[] = {{"uniform 1.5", 1.5, 1.5}, {"by status 1.8/1.0", 1.8, 1.0}};
    constexpr const char *orders[]      = {"sorted", "rows", "random"};
    constexpr double      tolerances[]  = {1e-4, 1e-5};

    // `rows`: ascending in (i, j). Grains are numbered upward before the loading, so rows are nearly sorted too.
    void set_order(ContactProblem &problem, const std::string &name)
    {
      if (name == "sorted")
        return;
      problem.order.resize(name == "rows" ? 0 : problem.contacts.size());
      std::iota(problem.order.begin(), problem.order.end(), 0);
      std::mt19937_64 random(1);
      for (std::size_t k = problem.order.size(); k > 1; --k) // Not std::shuffle: its order differs between libraries.
        std::swap(problem.order[k - 1], problem.order[random() % k]);
    }

    SolverOptions options_of(const Relaxation &relaxation, const double tolerance)
    {
      SolverOptions options;
      options.omega_sticking = relaxation.sticking;
      options.omega_slipping = relaxation.slipping;
      options.tolerance      = tolerance;
      options.max_sweeps     = 100000;
      return options;
    }

    void print_state(const std::string &states, const LoadCase &load, const int n)
    {
      MeasuredSolves measured[2][3][2];
      Sheared        sheared = sheared_state(states, 4000, load);
      for (int step = 0; step < n; ++step)
        {
          for (int order = 0; order < 3; ++order)
            {
              NextStep next = next_step(sheared);
              set_order(next.problem, orders[order]);
              for (int omega = 0; omega < 2; ++omega)
                for (int k = 0; k < 2; ++k)
                  measured[omega][order][k].add(next, options_of(relaxations[omega], tolerances[k]));
            }
          (void)advance(sheared);
        }
      for (int omega = 0; omega < 2; ++omega)
        for (int order = 0; order < 3; ++order)
          {
            std::printf("%-5s %-18s %-7s", load.name, relaxations[omega].name, orders[order]);
            for (const MeasuredSolves &m : measured[omega][order])
              std::printf(" %8.0f %8.4f  %2d of %d", spread(m.sweeps).median, spread(m.seconds).median, m.converged, n);
            std::printf("\n");
          }
      std::fflush(stdout);
    }
  } // namespace

  void sweep_orders(const std::string &states)
  {
    constexpr int n = 11;
    std::printf("4000 discs, %d consecutive steps, warm start, CPU time with batching, medians; at most 100000 sweeps\n", n);
    std::printf("state omega              order    1e-4: sweeps seconds converged  1e-5: sweeps seconds converged\n");
    for (const LoadCase &load : {state_a, state_b})
      print_state(states, load, n);
  }
} // namespace diptych::benchmarks
