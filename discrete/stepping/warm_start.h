// diptych: where the solution of a step starts
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "discrete/bodies/state.h"
#include "discrete/contacts/contact_detection.h"
#include "discrete/contacts/contact_problem.h"

namespace diptych::discrete
{
  // Of the preceding step, one entry per contact: impulses, and by how much they had changed in it. Zero for new contacts.
  struct FirstGuess
  {
    std::vector<Impulse> impulses, changes;
  };
  FirstGuess first_guess(const std::vector<PairImpulse> &previous, const std::vector<Contact> &contacts);

  // Adds a x changes to the impulses and clamps them to the Coulomb cone. The share a in [-1, 1] is that for which the violation
  // of the law does no work along the changes, sum change . (u + c) = 0 over what sticks or presses: a guess that runs ahead
  // where forces go on as they went, and stays where they do not. Sweeps reduce the error of long force chains last, and with it
  // the lag of the forces behind the strain.
  void extrapolate(const ContactProblem &problem, const std::vector<Impulse> &changes, std::vector<Impulse> &impulses);
} // namespace diptych::discrete
