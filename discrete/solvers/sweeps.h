// diptych: the two kinds of sweep over all contacts
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "discrete/contacts/contact_problem.h"

namespace diptych::discrete
{
  // One Gauss-Seidel pass in the order of the problem, omega = 1: the simple, slow reference.
  void sweep_nsgs(const ContactProblem &problem, std::vector<BodyVelocity> &v, std::vector<Impulse> &impulses);

  // One projected over-relaxed pass over the rows of `order`: the scalar reference of batched_sweep.h. A contact at its Coulomb
  // bound (by its old impulse) takes omega_slipping.
  void sweep_psor(const ContactProblem      &problem,
                  const std::vector<int>    &order,
                  double                     omega_sticking,
                  double                     omega_slipping,
                  std::vector<BodyVelocity> &v,
                  std::vector<Impulse>      &impulses);
} // namespace diptych::discrete
