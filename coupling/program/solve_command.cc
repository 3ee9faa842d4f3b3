// diptych: one stored contact problem, solved and measured
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/commands.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <sstream>
#include <stdexcept>

#include "coupling/processes/stop_signal.h"
#include "coupling/scene/scene_error.h"
#include "discrete/files/hdf5_file.h"
#include "discrete/problem_files/fclib.h"
#include "discrete/solvers/solver.h"

namespace diptych::coupling
{
  namespace
  {
    // The form asked for, by default the better one that the file has.
    discrete::ProblemForm form_of(const CommandLine &line, const discrete::StoredProblem &problem)
    {
      const discrete::ProblemForm form = line.solve.form.value_or(problem.form);
      if (const std::string obstacle = problem.obstacle(form); !obstacle.empty())
        throw std::invalid_argument("--form " + name_of(form) + ": " + line.target + " has no such form: " + obstacle);
      return form;
    }

    void print_problem(const CommandLine &line, const discrete::StoredProblem &problem, const discrete::ProblemForm form)
    {
      std::cout << "problem: " << line.target << "\ncontacts: " << problem.local.n_contacts() << "\n";
      if (problem.bodies)
        std::cout << "bodies: " << problem.bodies->free_velocity.size() << "\n";
      std::cout << "form: " << name_of(form);
      if (!problem.bodies)
        std::cout << " (" << problem.reason << ")";
      std::cout << "\n";
    }

    // A solution of this very problem: nothing else is lost where it is written anew.
    bool holds_solution_of(const discrete::StoredProblem &problem, const std::string &path)
    {
      try
        {
          if (!discrete::Hdf5Reader(path).has("/solution/r"))
            return false;
          const discrete::StoredProblem other = discrete::read_fclib(path);
          return other.local.friction == problem.local.friction && discrete::relative_difference(other.local, problem.local) == 0;
        }
      catch (const std::invalid_argument &)
        {
          return false;
        }
    }

    std::string status_of(const discrete::SolveReport &report)
    {
      return discrete::name_of(report.status);
    }

    void print_result(const CommandLine                    &line,
                      const discrete::SolveReport          &report,
                      const discrete::StoredProblem        &problem,
                      const std::vector<discrete::Impulse> &r)
    {
      const double sweeps = double(std::max(1l, report.sweeps)), updates = sweeps * double(std::max<std::size_t>(1, r.size()));
      std::cout << "solver: " << discrete::name_of(line.solve.options.solver) << "\ntolerance: " << line.solve.options.tolerance
                << "\nsweeps: " << report.sweeps << "\nresidual: " << report.residual
                << "\nvelocity_error: " << report.velocity_error << "\nsiconos_residual: " << problem.siconos_residual(r)
                << "\ncpu_s: " << report.cpu_s << "\nus_per_sweep: " << 1e6 * report.cpu_s / sweeps
                << "\nns_per_update: " << 1e9 * report.cpu_s / updates << "\nstatus: " << status_of(report) << std::endl;
    }
  } // namespace

  int solve_stored_problem(const CommandLine &line)
  {
    discrete::SolverOptions options = line.solve.options;
    options.stop_requested          = stop_requested;
    std::error_code error;
    if (!line.output.empty() && std::filesystem::equivalent(line.target, line.output, error))
      throw SceneError("--output " + line.output + " is the problem itself: name another file");
    const std::filesystem::path folder = std::filesystem::path(line.output).parent_path();
    if (!folder.empty() && !std::filesystem::is_directory(folder, error))
      throw SceneError("--output " + line.output + ": there is no folder " + folder.string());
    const discrete::StoredProblem problem = discrete::read_fclib(line.target);
    if (!line.output.empty() && std::filesystem::exists(line.output) && !holds_solution_of(problem, line.output))
      throw SceneError("--output " + line.output + " exists and is not a solution of " + line.target + "; name another file");
    const discrete::ProblemForm form = form_of(line, problem);

    std::vector<discrete::Impulse> r(problem.local.n_contacts());
    discrete::ThreadTeam           team(line.threads);
    const discrete::SolveReport    report = problem.solve(form, options, r, team);
    print_problem(line, problem, form);
    print_result(line, report, problem, r);
    if (const std::string obstacle = discrete::obstacle_to(report); !obstacle.empty())
      std::cerr << line.target << ": " << obstacle << "\n";
    if (!line.output.empty())
      discrete::write_solution(line.target, line.output,
                               {r, problem.velocities(r), discrete::name_of(options.solver) + ", " + name_of(form) + " form",
                                status_of(report), report.residual});
    return report.status == discrete::SolveStatus::converged ? done : not_converged;
  }
} // namespace diptych::coupling
