// diptych: velocities due to impulses, and the residual of a contact problem
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "discrete/contacts/contact_problem.h"

namespace diptych::discrete
{
  // Indices of the contacts with a nonzero impulse, ascending.
  std::vector<int> acting_contacts(const std::vector<Impulse> &impulses);

  // v = v_free + M^-1 H r for all bodies. The second version takes the result of acting_contacts().
  std::vector<BodyVelocity> velocities(const ContactProblem &problem, const std::vector<Impulse> &impulses);
  std::vector<BodyVelocity> velocities(const ContactProblem       &problem,
                                       const std::vector<Impulse> &impulses,
                                       const std::vector<int>     &acting);

  // Velocities with `free` in place of v_free.
  std::vector<BodyVelocity> velocities_from(const std::vector<BodyVelocity> &free,
                                            const ContactProblem            &problem,
                                            const std::vector<Impulse>      &impulses,
                                            const std::vector<int>          &acting);

  // Natural map ||r - P(r)||_2 / ||r||_2: P solves every contact for itself with its own W_nn and W_tt, all others held.
  // Recomputes v from r. Returns 0 if both r and P(r) vanish and infinity if only r vanishes.
  double natural_map_residual(const ContactProblem &problem, const std::vector<Impulse> &impulses);

  double natural_map_residual(const ContactProblem            &problem,
                              const std::vector<BodyVelocity> &v,
                              const std::vector<Impulse>      &impulses);

  // Velocity by which the contacts violate their laws (the change of the natural map times W_nn and W_tt), relative to the free
  // velocities of the contacts that act. It stays near 1 where impulses grow without stopping the bodies: a heavy body on a light
  // one, or a body that is squeezed between prescribed motions. The natural map relative to |r| falls there. Couples do not
  // count.
  double velocity_error(const ContactProblem &problem, const std::vector<BodyVelocity> &v, const std::vector<Impulse> &impulses);
} // namespace diptych::discrete
