// diptych: the few contacts on which sweeps stall, and sweeps over them alone
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "discrete/contacts/contact_problem.h"

namespace diptych::discrete
{
  // The contacts on which four fifths of |r - P(r)|^2 lie, with all others between the bodies of these and of the contacts in
  // `held`, ascending. None where they would be more than a twentieth of all (60 to 250):
  // then the sweeps do not stall on a few contacts.
  std::vector<int> stalled_contacts(const ContactProblem       &problem,
                                    const std::vector<Impulse> &impulses,
                                    const std::vector<int>     &held);

  // Plain sweeps over `rows` alone, all other contacts held, until they are solved to 1e-8 of |r| or 200 are done. `impulses`:
  // one a row, contained in the velocities `v` of all bodies, which follow.
  void sweep_alone(const ContactProblem &problem, const std::vector<int> &rows, std::vector<BodyVelocity> &v, Impulse *impulses);
} // namespace diptych::discrete
