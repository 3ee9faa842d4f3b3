// diptych: velocities due to impulses, and the residual of a contact problem
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/contacts/natural_map.h"

#include "discrete/contacts/contact_law.h"
#include "discrete/contacts/lattice_motion.h"

namespace diptych::discrete
{
  std::vector<int> acting_contacts(const std::vector<Impulse> &impulses)
  {
    // Branch-free, because no branch predictor can foresee which contacts act.
    std::vector<int> acting(impulses.size());
    std::size_t      n = 0;
    for (std::size_t k = 0; k < impulses.size(); ++k)
      {
        acting[n] = int(k);
        n += std::size_t(impulses[k].normal != 0) | std::size_t(impulses[k].tangential != 0);
      }
    acting.resize(n);
    return acting;
  }

  std::vector<BodyVelocity> velocities(const ContactProblem &problem, const std::vector<Impulse> &impulses)
  {
    return velocities(problem, impulses, acting_contacts(impulses));
  }

  std::vector<BodyVelocity> velocities(const ContactProblem       &problem,
                                       const std::vector<Impulse> &impulses,
                                       const std::vector<int>     &acting)
  {
    return velocities_from(problem.free_velocity, problem, impulses, acting);
  }

  std::vector<BodyVelocity> velocities_from(const std::vector<BodyVelocity> &free,
                                            const ContactProblem            &problem,
                                            const std::vector<Impulse>      &impulses,
                                            const std::vector<int>          &acting)
  {
    std::vector<BodyVelocity> v = free;
    for (std::size_t a = 0; a < acting.size(); ++a)
      {
        fetch_ahead(problem.contacts, acting, a);
        apply_impulse(problem.contacts[acting[a]], impulses[acting[a]], v);
      }
    follow_impulses(problem, free, impulses, v);
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

  double velocity_error(const ContactProblem &problem, const std::vector<BodyVelocity> &v, const std::vector<Impulse> &impulses)
  {
    VelocitySquares squares;
    for (std::size_t k = 0; k < problem.contacts.size(); ++k)
      {
        const ContactRow      &c    = problem.contacts[k];
        const RelativeVelocity free = relative_velocity(c, problem.free_velocity);
        squares.add(terms_of(c), {impulses[k].normal, impulses[k].tangential}, signorini_coulomb(c, v, impulses[k], exact),
                    {free.normal + c.normal_term, free.tangential + c.tangential_term});
      }
    return squares.relative();
  }
} // namespace diptych::discrete
