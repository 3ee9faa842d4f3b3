// diptych: estimated error of the grain stresses of an unfinished solve
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/stepping/grain_stress_error.h"

#include <algorithm>
#include <cmath>

#include "discrete/contacts/contact_law.h"
#include "discrete/stepping/step_problem.h"

namespace diptych::discrete
{
  namespace
  {
    constexpr double as_good_as_exact = 1e-9;
  }

  std::vector<double> contact_moments(const std::vector<double>  &radius,
                                      const std::vector<Contact> &contacts,
                                      const std::vector<Impulse> &impulses)
  {
    std::vector<double> moment(4 * radius.size(), 0.);
    for (std::size_t k = 0; k < contacts.size(); ++k)
      {
        const Contact &c = contacts[k];
        if (impulses[k].normal == 0)
          continue;
        const Eigen::Vector2d r = impulse_vector(c, impulses[k]);
        for (const int body : {c.i, c.j})
          if (std::size_t(body) < radius.size())
            for (int a = 0; a < 2; ++a)
              for (int b = 0; b < 2; ++b)
                moment[4 * body + 2 * a + b] += (radius[body] + 0.5 * c.gap) * c.normal[a] * r[b];
      }
    return moment;
  }

  double relative_difference(const std::vector<double> &a, const std::vector<double> &b)
  {
    double difference = 0, norm = 0;
    for (std::size_t k = 0; k < a.size(); ++k)
      {
        difference += (a[k] - b[k]) * (a[k] - b[k]);
        norm += b[k] * b[k];
      }
    return relative_norm(difference, norm);
  }

  void GrainStressError::observe(std::vector<double> moments)
  {
    if (!moments_.empty())
      changes_.push_back(relative_difference(moments_, moments));
    moments_ = std::move(moments);
    next_ *= 2;
  }

  double GrainStressError::estimate() const
  {
    constexpr double  least = 0.7, most = 0.9, safety = 4;
    const std::size_t n = changes_.size();
    if (n < 3)
      return std::numeric_limits<double>::infinity();
    const double last = changes_[n - 1];
    if (last == 0)
      return 0;
    const double q = std::max({least, last / changes_[n - 2], changes_[n - 2] / changes_[n - 3]});
    return q < most ? safety * last * q / (1 - q) : std::numeric_limits<double>::infinity();
  }

  bool GrainStressError::hopeless() const
  {
    constexpr double  falls = 0.9;
    const std::size_t n     = changes_.size();
    return n >= 4 && changes_[n - 1] >= falls * changes_[n - 2] && changes_[n - 2] >= falls * changes_[n - 3];
  }

  SolveReport solve_sampled(const SampledProblem &sampled,
                            const SolverOptions  &solver,
                            const SampleRequest  &request,
                            ThreadTeam           &team,
                            std::vector<Impulse> &impulses,
                            SampledAccuracy      &accuracy)
  {
    const auto moments = [&](const std::vector<Impulse> &r) { return contact_moments(sampled.radius, sampled.contacts, r); };
    // solve() calls the condition only if the residual is below its tolerance. An infinite tolerance makes it call at every
    // check.
    GrainStressError error;
    double           wanted   = request.options.snapshot_accuracy;
    double           residual = std::numeric_limits<double>::infinity();
    SolverOptions    on       = solver;
    on.tolerance              = std::numeric_limits<double>::max();
    on.max_sweeps             = std::max(solver.max_sweeps, request.options.snapshot_max_sweeps);
    const SolveReport report  = solve(sampled.problem, on, impulses, team,
                                      [&](const SolveReport &now, const std::function<std::vector<Impulse>()> &present) {
                                       residual = now.residual;
                                       if (residual <= std::min(as_good_as_exact, solver.tolerance))
                                         return true;
                                       if (error.wants(now.sweeps))
                                         error.observe(moments(present()));
                                       const bool used_up = now.sweeps >= request.options.snapshot_max_sweeps || error.hopeless();
                                       return residual <= solver.tolerance && (error.estimate() <= wanted || used_up);
                                     });
    accuracy.stress_error     = residual <= as_good_as_exact ? 0 : error.estimate();
    accuracy.stress_change    = error.change();
    accuracy.reached          = accuracy.stress_error <= wanted;

    if (request.measure_factor && accuracy.reached && request.options.reference_sweeps > 0)
      {
        std::vector<Impulse> reference = impulses;
        on.tolerance                   = as_good_as_exact;
        on.max_sweeps                  = request.options.reference_sweeps;
        accuracy.reference_residual    = solve(sampled.problem, on, reference, team).residual;
        accuracy.true_error            = relative_difference(moments(impulses), moments(reference));
        // Only a copy that is much closer to the solution can serve as reference.
        if (accuracy.reference_residual <= 0.1 * report.residual)
          accuracy.error_over_residual = accuracy.true_error / report.residual;
      }
    return report;
  }
} // namespace diptych::discrete
