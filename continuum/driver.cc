// diptych: adaptive load steps
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/driver.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace diptych::continuum
{
  namespace
  {
    constexpr int    easy   = 6; // Newton iterations up to which the next step may be longer
    constexpr double growth = 1.5;
  } // namespace

  LoadDriver::LoadDriver(BoundaryValueProblem &problem, const Options &options)
      : problem(problem),
        options(options),
        step(std::min(options.initial_step, options.max_step)),
        last_increment(problem.zero_vector())
  {}

  NewtonReport LoadDriver::attempt(DistributedVector &increment)
  {
    const auto report = solve_step(problem, solver, {options.tolerance, options.max_newton_iterations}, increment);
    count.newton_iterations += report.iterations;
    if (!report.converged)
      {
        ++count.cut_backs;
        solver.forget(); // factors of a state that never was
      }
    return report;
  }

  std::string LoadDriver::equilibrate()
  {
    double share = 0, d_share = 1;
    while (share < 1)
      {
        const double target    = std::min(1., share + d_share);
        auto         increment = problem.zero_vector();
        problem.set_lateral_load(0, target);
        const auto report = attempt(increment);
        if (report.converged)
          {
            problem.commit(0);
            share = target;
            continue;
          }
        d_share /= 2;
        if (d_share < 1e-3)
          return "no equilibrium of the initial state under the lateral pressure (" + report.message +
                 "); is the outline too rough?";
      }
    return {};
  }

  // The last increment, scaled. It already holds the band's pattern of loading and unloading, which a tangent at the
  // beginning of the step does not. The first step has only the tangent.
  DistributedVector LoadDriver::predict(const double size)
  {
    if (last_step > 0)
      {
        auto increment = last_increment;
        increment *= size / last_step;
        return increment;
      }
    (void)problem.evaluate(problem.zero_vector());
    auto increment  = problem.platen_increment(size);
    auto correction = problem.zero_vector();
    if (solver.solve(problem.assemble_tangent(), correction, problem.linearised_residual(increment)))
      increment += correction;
    return increment;
  }

  std::string LoadDriver::advance(const double axial_strain, const std::function<bool()> &after_step)
  {
    while (problem.axial_strain() < axial_strain)
      {
        // Equal steps to the stage: a short last one would be a bad base for the next extrapolation.
        const double remaining = axial_strain - problem.axial_strain();
        const double n_steps   = std::ceil(remaining / step * (1 - 1e-9));
        const double size      = remaining / n_steps;
        auto         increment = predict(size);
        // At the committed positions instead, the load would jump by a whole step however small the present one is.
        problem.set_lateral_load(n_steps == 1 ? axial_strain : problem.axial_strain() + size);
        const auto report = attempt(increment);
        if (!report.converged)
          {
            step = size / 2;
            if (step >= options.min_step)
              continue;
            std::ostringstream why;
            why << "stopped at axial strain " << problem.axial_strain() << ": a step of " << size << " fails (" << report.message
                << ") and half of it is below min_step";
            return why.str();
          }
        problem.commit(n_steps == 1 ? axial_strain : problem.axial_strain() + size);
        last_increment = increment;
        last_step      = size;
        ++count.steps;
        adapt(report);
        if (!after_step())
          return {};
      }
    return {};
  }

  void LoadDriver::adapt(const NewtonReport &report)
  {
    if (report.iterations <= easy)
      step = std::min(options.max_step, std::max(step, growth * last_step));
  }
} // namespace diptych::continuum
