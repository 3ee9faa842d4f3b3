// diptych: adaptive load steps
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/equilibrium/driver.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

namespace diptych::continuum
{
  namespace
  {
    constexpr int    easy   = 6; // with at most this many Newton iterations the next step may be longer
    constexpr double growth = 1.5;

    // Translations along x and y and the rotation about the origin, with Cosserat rotations, at the present shape.
    RigidModes rigid_modes(const BoundaryValueProblem &problem)
    {
      const auto                      &mesh = problem.discretisation();
      const auto                       x    = positions(mesh, problem.committed().displacement);
      std::vector<std::vector<double>> modes(3, std::vector<double>(mesh.relevant.n_elements(), 0.));
      for (std::size_t k = 0; k < mesh.nodes.size(); ++k)
        {
          const auto &node        = mesh.nodes[k];
          modes[0][node.local[0]] = 1;
          modes[1][node.local[1]] = 1;
          modes[2][node.local[0]] = -x[k].y();
          modes[2][node.local[1]] = x[k].x();
          if (mesh.kind == ElementKind::q2_cosserat && node.rotation != dealii::numbers::invalid_dof_index)
            modes[2][node.local_rotation] = 1;
        }
      RigidModes result;
      for (const auto &mode : modes)
        result.push_back(problem.owned_values(mode));
      return result;
    }

    std::size_t n_unknowns(const BoundaryValueProblem &problem)
    {
      return problem.discretisation().dof_handler.n_dofs();
    }
  } // namespace

  LoadDriver::LoadDriver(BoundaryValueProblem &problem, const Options &options, StopRequest stop_requested)
      : problem(problem),
        options(options),
        stop_requested(std::move(stop_requested)),
        solver(linear_method(options.linear_solver, n_unknowns(problem), problem.discretisation().communicator()))
  {
    DriverState start;
    start.step = std::min(options.initial_step, options.max_step);
    start.last.increment.assign(problem.committed().displacement.size(), 0.);
    start.last.curvature = start.last.increment;
    restart(start);
  }

  void LoadDriver::restart(DriverState new_state)
  {
    now     = std::move(new_state);
    version = 0;
    follow_structure();
  }

  // The analysis of the matrix is valid only for one set of unknowns and constraints.
  void LoadDriver::follow_structure()
  {
    if (version == problem.version())
      return;
    solver.restart(linear_method(options.linear_solver, n_unknowns(problem), problem.discretisation().communicator()),
                   rigid_modes(problem));
    version = problem.version();
  }

  NewtonReport LoadDriver::attempt(DistributedVector &increment, const StopRequest &stop)
  {
    follow_structure();
    const auto report = solve_step(problem, solver, {options.tolerance, options.max_newton_iterations, stop}, increment);
    now.count.newton_iterations += report.iterations;
    if (!report.converged && !report.stopped)
      {
        ++now.count.cut_backs;
        solver.forget(); // these factors belong to a rejected state
      }
    return report;
  }

  std::string LoadDriver::give_up(DriverState before)
  {
    stopped = true;
    now     = std::move(before);
    solver.put_back();
    return "stopped on request";
  }

  std::string LoadDriver::equilibrate()
  {
    return find_equilibrium(stop_requested);
  }

  std::string LoadDriver::find_equilibrium(const StopRequest &stop)
  {
    const double                  progress = problem.progress();
    const DriverState             before   = now;
    std::optional<CommittedState> start; // set if a part of the loads was committed
    double                        share = 0, d_share = 1;
    stopped = false;
    follow_structure();
    if (stop)
      solver.remember();
    while (share < 1)
      {
        const double target    = std::min(1., share + d_share);
        auto         increment = problem.zero_vector();
        problem.begin_step(progress, target);
        const auto report = attempt(increment, stop);
        if (report.stopped)
          {
            if (start)
              problem.adopt(std::move(*start));
            return give_up(before);
          }
        if (report.converged)
          {
            if (stop && target < 1 && !start)
              start = problem.committed();
            problem.commit();
            share = target;
            continue;
          }
        d_share /= 2;
        if (d_share < 1e-3)
          return "no equilibrium at rest under the loads (" + report.message + ")" +
                 (progress > 0 ? " after a refinement"
                               : ": the initial stress does not fit a free edge or a wavy outline, or exceeds the strength");
      }
    solver.forget_memory();
    return {};
  }

  // Extrapolates the last increment, or the last two while the motion is smooth: where it is not, a bold guess leads to
  // another of several solutions. The increments already contain the band's pattern of loading and unloading, which a tangent
  // at the beginning of the step does not. The first step has only the tangent.
  DistributedVector LoadDriver::predict(const double to)
  {
    if (now.last_step > 0)
      {
        const double size      = to - problem.progress();
        auto         increment = problem.owned_values(now.last.increment);
        increment *= size / now.last_step;
        if (now.is_smooth)
          increment.add(size * (size + now.last_step) / 2, problem.owned_values(now.last.curvature));
        problem.impose(increment);
        return increment;
      }
    follow_structure();
    auto increment = problem.zero_vector(), correction = problem.zero_vector();
    problem.impose(increment);
    const auto rhs = problem.linearised_residual(increment);
    if (solver.solve(problem.assemble_tangent(), correction, rhs))
      {
        problem.correction_constraints().distribute(correction);
        increment += correction;
      }
    return increment;
  }

  std::string LoadDriver::refine_and_equilibrate()
  {
    if (options.refinement != Refinement::adaptive)
      return {};
    const RefinementRule rule{options.refinement_levels, options.refinement_threshold};
    const auto           divided = refine(problem, rule, plastic_increments(problem), now.last);
    if (divided)
      {
        ++now.count.refinements;
        now.divisions.push_back(*divided);
        restart(now);
        if (const auto why = find_equilibrium({}); !why.empty()) // the accepted step exists only on the new mesh, so no stop here
          return why;
      }
    return {};
  }

  std::string LoadDriver::step_towards(const double progress)
  {
    stopped = false;
    follow_structure();
    const DriverState before = now;
    if (stop_requested)
      solver.remember();
    while (true)
      {
        // Divides the way to the stage into equal steps, because a short last step is a poor basis for the next extrapolation.
        const double remaining = progress - problem.progress();
        const double n_steps   = std::ceil(remaining / now.step * (1 - 1e-9));
        const double size      = remaining / n_steps;
        const double to        = n_steps == 1 ? progress : problem.progress() + size;
        problem.begin_step(to);
        auto       increment = predict(to);
        const auto report    = attempt(increment, stop_requested);
        if (report.stopped)
          {
            return give_up(before);
          }
        if (report.converged)
          {
            accept(increment, size, report.iterations);
            return refine_and_equilibrate();
          }
        now.step      = size / 2;
        now.is_smooth = false;
        if (now.step >= options.min_step)
          continue;
        std::ostringstream why;
        why << "a step of " << size << " fails (" << report.message << ") and half of it is below min_step";
        return why.str();
      }
  }

  void LoadDriver::accept(const DistributedVector &increment, const double size, const int iterations)
  {
    problem.commit();
    solver.forget_memory();
    const auto latest = problem.relevant_values(increment);
    if (now.last_step > 0)
      {
        const double between  = (size + now.last_step) / 2;
        auto         expected = now.last.curvature;
        for (std::size_t i = 0; i < latest.size(); ++i)
          now.last.curvature[i] = (latest[i] / size - now.last.increment[i] / now.last_step) / between;
        auto         surprise = problem.owned_values(now.last.curvature);
        const double change   = surprise.l2_norm();
        surprise -= problem.owned_values(expected);
        now.is_smooth = surprise.l2_norm() < 0.5 * change;
      }
    now.last.increment = latest;
    now.last_step      = size;
    ++now.count.steps;
    if (iterations <= easy)
      now.step = std::min(options.max_step, std::max(now.step, growth * size));
  }
} // namespace diptych::continuum
