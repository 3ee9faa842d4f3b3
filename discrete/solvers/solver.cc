// diptych: sweeps until the residual, measured outside the sweeps, is small
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/solvers/solver.h"

#include <ctime>
#include <iomanip>
#include <sstream>

#include "discrete/contacts/natural_map.h"
#include "discrete/solvers/iteration.h"
#include "discrete/solvers/stall_relief.h"
#include "discrete/solvers/sweeps.h"

namespace diptych::discrete
{
  namespace
  {
    SolveReport solve_nsgs(const ContactProblem &problem,
                           const SolverOptions  &options,
                           std::vector<Impulse> &impulses,
                           const StopTest       &stop_test)
    {
      std::vector<BodyVelocity> v;
      Iteration                 iteration;
      iteration.refresh = [&] { v = velocities(problem, impulses); };
      iteration.sweep   = [&](double, double, const int n) {
        for (int k = 0; k < n; ++k)
          sweep_nsgs(problem, v, impulses);
      };
      iteration.residual       = [&] { return natural_map_residual(problem, v, impulses); };
      iteration.velocity_error = [&] { return velocity_error(problem, v, impulses); };
      if (stop_test)
        iteration.good_enough = [&](const SolveReport &report) { return stop_test(report, [&] { return impulses; }); };
      return iterate(options, iteration);
    }

    SolveReport solve_psor(const ContactProblem &problem,
                           const SolverOptions  &options,
                           std::vector<Impulse> &impulses,
                           ThreadTeam           &team,
                           const StopTest       &stop_test)
    {
      const std::clock_t begin = std::clock();
      RelievedSweeps     sweeps(problem, impulses, team.processes());
      Iteration          iteration;
      iteration.refresh = [&] { sweeps.refresh_velocities(); };
      iteration.sweep   = [&](const double sticking, const double slipping, const int n) {
        sweeps.sweep(sticking, slipping, n, team);
      };
      iteration.residual       = [&] { return sweeps.residual(team); };
      iteration.velocity_error = [&] { return velocity_error(problem, sweeps.velocities(), sweeps.impulses()); };
      iteration.relieve        = [&] { return sweeps.relieve(); };
      if (stop_test)
        iteration.good_enough = [&](const SolveReport &report) { return stop_test(report, [&] { return sweeps.impulses(); }); };
      SolveReport report = iterate(options, iteration);
      impulses           = sweeps.impulses();
      report.relieved    = sweeps.n_relieved();
      report.cpu_s       = double(std::clock() - begin) / CLOCKS_PER_SEC;
      return report;
    }
  } // namespace

  SolveReport solve(const ContactProblem &problem,
                    const SolverOptions  &options,
                    std::vector<Impulse> &impulses,
                    ThreadTeam           &team,
                    const StopTest       &stop_test)
  {
    return options.solver == ContactSolver::nsgs ? solve_nsgs(problem, options, impulses, stop_test)
                                                 : solve_psor(problem, options, impulses, team, stop_test);
  }

  std::string obstacle_to(const SolveReport &report)
  {
    if (!(report.velocity_error > SolverOptions{}.velocity_tolerance))
      return {};
    std::ostringstream text;
    text << "the contacts still violate their laws by " << std::setprecision(3) << report.velocity_error
         << " of their free velocity: either no impulses solve the problem (bodies are squeezed between "
         << "prescribed motions), or masses differ so much that more sweeps are needed";
    return text.str();
  }

  SolveReport solve(const ContactProblem &problem, const SolverOptions &options, std::vector<Impulse> &impulses)
  {
    ThreadTeam one_thread(1);
    return solve(problem, options, impulses, one_thread);
  }
} // namespace diptych::discrete
