// diptych: the two kinds of sweep over all contacts
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/solvers/sweeps.h"

#include "discrete/contacts/contact_law.h"
#include "discrete/contacts/lattice_motion.h"

namespace diptych::discrete
{
  void sweep_nsgs(const ContactProblem &problem, std::vector<BodyVelocity> &v, std::vector<Impulse> &impulses)
  {
    if (problem.order.empty())
      for (std::size_t k = 0; k < problem.contacts.size(); ++k)
        update(problem.contacts[k], exact, v, impulses[k]);
    for (const int k : problem.order)
      update(problem.contacts[k], exact, v, impulses[k]);
    follow_impulses(problem, problem.free_velocity, impulses, v);
  }

  void sweep_psor(const ContactProblem      &problem,
                  const std::vector<int>    &order,
                  const double               omega_sticking,
                  const double               omega_slipping,
                  std::vector<BodyVelocity> &v,
                  std::vector<Impulse>      &impulses)
  {
    for (const int k : order)
      update(problem.contacts[k], {omega_sticking, omega_slipping}, v, impulses[k]);
  }
} // namespace diptych::discrete
