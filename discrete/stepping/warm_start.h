// diptych: first guess of the solution of a step
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "discrete/bodies/state.h"
#include "discrete/contacts/contact_detection.h"
#include "discrete/contacts/contact_problem.h"

namespace diptych::discrete
{
  // Impulses of the last step and their change in it, one entry per contact. Zero for new contacts.
  struct FirstGuess
  {
    std::vector<Impulse> impulses, changes;
  };
  FirstGuess first_guess(const std::vector<PairImpulse> &previous, const std::vector<Contact> &contacts);

  // Adds a x changes to the impulses and clamps them to the Coulomb cone. With the share a in [-1, 1] the violation of the law
  // does no work along the changes: sum change . (u + c) = 0 over the contacts that stick or press. The guess runs ahead if
  // forces keep changing as before. It reduces the lag of the forces behind the strain, because sweeps correct long force
  // chains last.
  void extrapolate(const ContactProblem &problem, const std::vector<Impulse> &changes, std::vector<Impulse> &impulses);
} // namespace diptych::discrete
