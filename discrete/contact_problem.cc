// diptych: the contact problem of one step as data, and its residual
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/contact_problem.h"

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
    NaturalMapSquares squares;
    for (std::size_t k = 0; k < problem.contacts.size(); ++k)
      squares.add(problem.contacts[k], v, impulses[k]);
    return relative_norm(squares.difference, squares.norm);
  }
} // namespace diptych::discrete
