// diptych: removal of the penetration that a step leaves
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "discrete/contacts/contact_detection.h"
#include "discrete/contacts/contact_problem.h"
#include "discrete/solvers/thread_team.h"

namespace diptych::discrete
{
  // A step's contact problem, which the correction overwrites, with its solution.
  struct SolvedContacts
  {
    ContactProblem                  &problem;
    const std::vector<Contact>      &contacts; // at mid-step
    const std::vector<Impulse>      &impulses;
    const std::vector<BodyVelocity> &v_new;
    double                           step;
  };

  // Ten Gauss-Seidel sweeps of the contact law on displacements h w, with w = M^-1 H (r' - r), starting from the impulses r of
  // the step:
  //   0 <= g + h (u_n' + w_n)  _|_  r_n' >= 0,   |r_t'| <= mu r_n', sliding against w_t.
  // Loaded contacts keep their friction while their grains move apart. Without friction they would slide, and the sample would
  // absorb the overlap without giving its volume back. Adds no velocity and no impulse. Does nothing if no penetration at the
  // next mid-step exceeds `enough` [length].
  void correct_positions(State &state, const SolvedContacts &solved, double enough, ThreadTeam &team);
} // namespace diptych::discrete
