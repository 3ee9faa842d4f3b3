// diptych: Newton's method for one load step
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/equilibrium/newton.h"

#include <algorithm>
#include <cmath>

namespace diptych::continuum
{
  namespace
  {
    bool is_usable(const Imbalance &imbalance)
    {
      return imbalance.n_failed + imbalance.n_inverted == 0 && std::isfinite(imbalance.residual);
    }

    Imbalance add_with_line_search(BoundaryValueProblem    &problem,
                                   const DistributedVector &correction,
                                   const double             before,
                                   DistributedVector       &increment)
    {
      const auto start = increment;
      increment += correction;
      Imbalance best      = problem.evaluate(increment);
      double    best_size = 1, last_size = 1;
      for (const double size : {0.5, 0.25})
        {
          if (is_usable(best) && best.residual < before)
            break;
          increment = start;
          increment.add(size, correction);
          const Imbalance shorter = problem.evaluate(increment);
          last_size               = size;
          if (!is_usable(best) || (is_usable(shorter) && shorter.residual < best.residual))
            {
              best      = shorter;
              best_size = size;
            }
        }
      if (best_size == last_size)
        return best;
      increment = start;
      increment.add(best_size, correction);
      return problem.evaluate(increment);
    }
  } // namespace

  NewtonReport solve_step(BoundaryValueProblem &problem,
                          LinearSolver         &solver,
                          const NewtonOptions  &options,
                          DistributedVector    &increment)
  {
    NewtonReport report;
    Imbalance    imbalance  = problem.evaluate(increment);
    double       best       = imbalance.residual;
    auto         correction = problem.zero_vector();
    while (true)
      {
        report.residual = imbalance.relative();
        best            = std::min(best, imbalance.residual);
        if (imbalance.n_inverted > 0)
          report.message = "an element is inverted";
        else if (!is_usable(imbalance))
          {
            const std::string failure = problem.law_failure();
            report.message            = "the law failed at " + std::to_string(imbalance.n_failed) + " points" +
                             (failure.empty() ? "" : ", such as: " + failure);
          }
        else if (report.residual <= options.tolerance)
          {
            report.converged = !problem.is_folded();
            if (!report.converged)
              report.message = "an element is inverted";
          }
        else if (imbalance.residual > 100 * best)
          report.message = "the residual grew by a factor of 100";
        else if (report.iterations == options.max_iterations)
          report.message = std::to_string(report.iterations) + " Newton iterations left a relative residual of " +
                           std::to_string(report.residual);
        else if (options.stop_requested && options.stop_requested())
          {
            report.stopped = true;
            report.message = "stopped on request";
          }
        else if (!solver.solve(problem.assemble_tangent(std::min(1., report.residual)), correction, problem.negative_residual()))
          report.message = "the linear system could not be solved";
        if (report.converged || !report.message.empty())
          return report;
        ++report.iterations;
        problem.correction_constraints().distribute(correction);
        imbalance = add_with_line_search(problem, correction, imbalance.residual, increment);
      }
  }
} // namespace diptych::continuum
