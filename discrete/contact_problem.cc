// diptych: the contact problem of one step as data, and its residual
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/contact_problem.h"

#include <cmath>
#include <limits>

#include "discrete/contact_law.h"

namespace diptych::discrete
{
  std::vector<BodyVelocity> velocities(const ContactProblem &problem, const std::vector<Impulse> &impulses)
  {
    std::vector<BodyVelocity> v = problem.free_velocity;
    for (std::size_t k = 0; k < problem.contacts.size(); ++k)
      if (impulses[k].normal != 0 || impulses[k].tangential != 0)
        apply_impulse(problem.contacts[k], impulses[k], v);
    return v;
  }

  double natural_map_residual(const ContactProblem &problem, const std::vector<Impulse> &impulses)
  {
    return natural_map_residual(problem, velocities(problem, impulses), impulses);
  }

  double natural_map_residual(const ContactProblem            &problem,
                              const std::vector<BodyVelocity> &v,
                              const std::vector<Impulse>      &impulses)
  {
    double difference = 0, norm = 0;
    for (std::size_t k = 0; k < problem.contacts.size(); ++k)
      {
        const ContactRow &c = problem.contacts[k];
        const Impulse     r = impulses[k], p = local_solution(c, relative_velocity(c, v), r, 1.);
        difference += (r.normal - p.normal) * (r.normal - p.normal) +
                      (r.tangential - p.tangential) * (r.tangential - p.tangential);
        norm += r.normal * r.normal + r.tangential * r.tangential;
      }
    if (difference == 0)
      return 0;
    return norm > 0 ? std::sqrt(difference / norm) : std::numeric_limits<double>::infinity();
  }
} // namespace diptych::discrete
