// diptych: the contact problem of a step, from the bodies and their contacts
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "discrete/contacts/contact_detection.h"
#include "discrete/contacts/contact_problem.h"

namespace diptych::discrete
{
  struct StepOptions;
  struct StepSetting;

  // Velocities of all bodies in the form of the contact problem: grains, walls, the cell if its width is free.
  std::vector<BodyVelocity> body_velocities(const State &state);

  // v + h M^-1 F: `force` on each grain, walls and cell driven as they say, prescribed components as at the end of the step.
  std::vector<BodyVelocity> free_velocities(const State                        &state,
                                            const std::vector<BodyVelocity>    &v,
                                            const std::vector<Eigen::Vector2d> &force,
                                            const StepSetting                  &setting);

  // Rows in the order of `contacts`, swept upward. `v`: velocities at the beginning of the step, for impacts. `problem` brings
  // the free velocities, and maybe rows of the preceding step, whose memory is used again.
  ContactProblem make_problem(const State                     &state,
                              const StepSetting               &setting,
                              const std::vector<Contact>      &contacts,
                              const std::vector<BodyVelocity> &v,
                              ContactProblem                   problem);

  // Impulse of a contact as a vector on body i.
  inline Eigen::Vector2d impulse_vector(const Contact &c, const Impulse &r)
  {
    return {c.normal.x() * r.normal - c.normal.y() * r.tangential, c.normal.y() * r.normal + c.normal.x() * r.tangential};
  }

  // What a closed contact takes back of its penetration within the step through its normal term, as a share.
  double corrected_share(const StepOptions &time);

  // Coulomb coefficient between a grain and body j.
  double friction_of(const State &state, const StepSetting &setting, int body_j);
} // namespace diptych::discrete
