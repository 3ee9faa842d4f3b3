// diptych: the few contacts on which sweeps stall, and sweeps over them only
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "discrete/contacts/contact_problem.h"

namespace diptych::discrete
{
  // The contacts that make up four fifths of |r - P(r)|^2, ascending. All contacts between their bodies and those of `held` are
  // included. Empty if these are more than a twentieth of all (60 to 250), because then the sweeps do not stall on a few
  // contacts.
  std::vector<int> stalled_contacts(const ContactProblem       &problem,
                                    const std::vector<Impulse> &impulses,
                                    const std::vector<int>     &held);

  // Plain sweeps over `rows` with all other contacts held, until they are solved to 1e-8 of |r| or 200 sweeps are done.
  // `impulses` has one entry per row; the velocities `v` of all bodies contain them and are updated.
  void sweep_alone(const ContactProblem &problem, const std::vector<int> &rows, std::vector<BodyVelocity> &v, Impulse *impulses);
} // namespace diptych::discrete
