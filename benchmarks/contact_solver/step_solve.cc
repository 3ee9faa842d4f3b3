// diptych: the solve of one step of 4000 discs in shear, and the smallest residuals that the solvers reach
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
    struct Target
    {
      double tolerance, seconds;
    };

    SolverOptions options_of(const ContactSolver solver, const double tolerance, const int max_sweeps)
    {
      SolverOptions options;
      options.solver     = solver;
      options.tolerance  = tolerance;
      options.max_sweeps = max_sweeps;
      return options;
    }

    // Results of `n` consecutive steps, each solved with each of the options.
    std::vector<MeasuredSolves> solve_steps(Sheared sheared, const std::vector<SolverOptions> &options, const int n)
    {
      std::vector<MeasuredSolves> measured(options.size());
      for (int step = 0; step < n; ++step)
        {
          const NextStep next = next_step(sheared);
          for (std::size_t k = 0; k < options.size(); ++k)
            measured[k].add(next, options[k]);
          (void)advance(sheared);
        }
      return measured;
    }

    void print_far(const Sheared &sheared, const LoadCase &load, const SolverOptions &options, const int n)
    {
      const MeasuredSolves measured = solve_steps(sheared, {options}, n).front();
      const Spread         s = spread(measured.seconds), sweeps = spread(measured.sweeps), reached = spread(measured.residuals);
      std::printf("%6zu %-5s %-5s %9.0e   %2d of %2d   %8.1e %8.1e %8.1e   %8.0f %8.0f %8.0f   %8.2f %8.2f %8.2f\n",
                  sheared.state.grains.size(), load.name, name_of(options.solver).c_str(), options.tolerance, measured.converged,
                  n, reached.least, reached.median, reached.most, sweeps.least, sweeps.median, sweeps.most, s.least, s.median,
                  s.most);
      std::fflush(stdout);
    }
  } // namespace

  void step_solve(const std::string &states)
  {
    constexpr int             n         = 11;
    const std::vector<Target> targets[] = {{{1e-4, 0.02}, {1e-5, 0.12}, {1e-6, 0.3}}, {{1e-4, 0.03}, {1e-5, 0.3}, {1e-6, 2}}};
    std::printf("4000 discs at 1 %% axial strain, %d consecutive steps, warm start, psor, CPU time with batching, at most 200000 "
                "sweeps\n",
                n);
    std::printf("state tolerance   seconds: least median   most    sweeps: least median   most  converged  target\n");
    for (const LoadCase &load : {state_a, state_b})
      {
        const std::vector<Target> &wanted = targets[load.name[0] == 'B'];
        std::vector<SolverOptions> options;
        for (const Target &target : wanted)
          options.push_back(options_of(ContactSolver::psor, target.tolerance, 200000));
        const std::vector<MeasuredSolves> measured = solve_steps(sheared_state(states, 4000, load), options, n);
        for (std::size_t k = 0; k < wanted.size(); ++k)
          {
            const Spread s = spread(measured[k].seconds), sweeps = spread(measured[k].sweeps);
            std::printf("%-5s %9.0e         %7.3f %7.3f %7.3f        %6.0f %6.0f %6.0f   %2d of %d  %5.2f s %s\n", load.name,
                        wanted[k].tolerance, s.least, s.median, s.most, sweeps.least, sweeps.median, sweeps.most,
                        measured[k].converged, n, wanted[k].seconds, s.median <= wanted[k].seconds ? "met" : "NOT MET");
          }
        std::fflush(stdout);
      }
  }

  void how_far(const std::string &states)
  {
    constexpr int n = 7;
    std::printf(
      "%d consecutive steps (nsgs: one), warm start, CPU time; at most 1e6 sweeps (16000 discs: 3e5); residual, sweeps and "
      "seconds: least, median, most\n",
      n);
    std::printf(
      " discs state solver  wanted  converged     reached: residual                sweeps                     seconds\n");
    for (const int grains : {1000, 4000})
      for (const LoadCase &load : {state_a, state_b})
        {
          const Sheared sheared = sheared_state(states, grains, load);
          print_far(sheared, load, options_of(ContactSolver::psor, 1e-8, 1000000), n);
          print_far(sheared, load, options_of(ContactSolver::nsgs, 1e-8, 1000000), 1);
        }
    for (const LoadCase &load : {state_a, state_b})
      print_far(sheared_state(states, 16000, load), load, options_of(ContactSolver::psor, 1e-6, 300000), n);
  }
} // namespace diptych::benchmarks
