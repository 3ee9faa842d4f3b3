// diptych: every solver and form of the problem on the stored contact problems
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cstdio>

#include "benchmarks/contact_solver/measuring.h"
#include "benchmarks/contact_solver/sections.h"
#include "discrete/problem_files/fclib.h"
#include "discrete/solvers/solver.h"

namespace diptych::benchmarks
{
  using namespace diptych::discrete;

  namespace
  {
    constexpr double enough_seconds = 2; // Longer solves are not repeated.

    // Solves from zero impulses.
    void print_solve(const StoredProblem &problem, const char *file, const char *form, const SolverOptions &options)
    {
      SolveReport         report;
      std::vector<double> seconds;
      while (seconds.size() < 5 && (seconds.empty() || seconds.front() < enough_seconds))
        {
          std::vector<Impulse> r(problem.local.n_contacts());
          const double         begin = cpu_seconds();
          report = std::string(form) == "body" ? solve(*problem.bodies, options, r) : solve(problem.local, options, r);
          seconds.push_back(cpu_seconds() - begin);
        }
      const double median = spread(seconds).median;
      std::printf("%-7s %8zu  %-5s %-5s %9.0e %8ld %9.4f %8.1f  %s\n", file, problem.local.n_contacts(), form,
                  name_of(options.solver).c_str(), options.tolerance, report.sweeps, median,
                  1e9 * median / (double(std::max(1L, report.sweeps)) * double(problem.local.n_contacts())),
                  report.status == SolveStatus::converged ? "converged" : "NOT converged");
      std::fflush(stdout);
    }
  } // namespace

  void stored_problems(const std::string &)
  {
    std::printf("from zero impulses, natural map relative to |r|, CPU time of the whole solve, median of 5\n");
    std::printf("file    contacts  form  solver tolerance  sweeps   seconds  ns/update\n");
    for (const char *file : {"small", "medium"})
      {
        const StoredProblem problem = read_fclib(std::string(DIPTYCH_CONTACT_PROBLEMS) + "/" + file + ".h5");
        for (const char *form : {"body", "local"})
          for (const ContactSolver solver : {ContactSolver::psor, ContactSolver::nsgs})
            for (const double tolerance : {1e-4, 1e-8})
              {
                if (std::string(form) == "body" && !problem.bodies)
                  continue;
                SolverOptions options;
                options.solver     = solver;
                options.tolerance  = tolerance;
                options.max_sweeps = 1000000;
                print_solve(problem, file, form, options);
              }
      }
    std::printf("target: medium to 1e-8 in 0.5 s\n");
  }
} // namespace diptych::benchmarks
