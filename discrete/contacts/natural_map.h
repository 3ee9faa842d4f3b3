// diptych: velocities that impulses cause, and the residual of a contact problem
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "discrete/contacts/contact_problem.h"

namespace diptych::discrete
{
  // Contacts whose impulse does not vanish, ascending.
  std::vector<int> acting_contacts(const std::vector<Impulse> &impulses);

  // v = v_free + M^-1 H r for all bodies; the same with acting_contacts() at hand.
  std::vector<BodyVelocity> velocities(const ContactProblem &problem, const std::vector<Impulse> &impulses);
  std::vector<BodyVelocity> velocities(const ContactProblem       &problem,
                                       const std::vector<Impulse> &impulses,
                                       const std::vector<int>     &acting);

  // Natural map ||r - P(r)||_2 / ||r||_2: P solves every contact for itself with its own W_nn and W_tt, all others held, v
  // computed afresh from r. Returns 0 where nothing acts and nothing should; infinity where r vanishes but P(r) does not.
  double natural_map_residual(const ContactProblem &problem, const std::vector<Impulse> &impulses);

  // The same with v = v_free + M^-1 H r at hand.
  double natural_map_residual(const ContactProblem            &problem,
                              const std::vector<BodyVelocity> &v,
                              const std::vector<Impulse>      &impulses);
} // namespace diptych::discrete
