// diptych: contact problem of a step, made from the bodies and their contacts
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "discrete/contacts/contact_detection.h"
#include "discrete/contacts/contact_problem.h"
#include "discrete/stepping/step_ledger.h"

namespace diptych::discrete
{
  struct StepOptions;
  struct StepSetting;

  // Velocities of all bodies in the form of the contact problem: grains, walls, and a periodic width if it moves, or the lattice.
  std::vector<BodyVelocity> body_velocities(const State &state);

  // v + h M^-1 F: `force` acts on the grains, and the drives act on walls, width and lattice. Prescribed components have the
  // value at the end of the step.
  std::vector<BodyVelocity> free_velocities(const State                        &state,
                                            const std::vector<BodyVelocity>    &v,
                                            const std::vector<Eigen::Vector2d> &force,
                                            const StepSetting                  &setting);

  // Rows in the order of `contacts`, to be swept upward. `v` is the velocity at the beginning of the step, which decides on
  // impacts. `problem` holds the free velocities, and perhaps rows of the last step; their memory is reused.
  ContactProblem make_problem(const State                     &state,
                              const StepSetting               &setting,
                              const std::vector<Contact>      &contacts,
                              const std::vector<BodyVelocity> &v,
                              ContactProblem                   problem);

  // Springs of setting.compliance for the rows of make_problem(), `last` holds the impulses of the last step of the same length.
  // With stiffness kn, overlap -g' at the next q_m, g' = g + h u_n', and dashpot c (0 if the contact is still open, g >= 0):
  //   r_n = h max(0, -kn g' - c u_n'),   r_t = r_t of the last step - h^2 kt u_t'  clamped to +-mu r_n,
  // and couples like r_t. This is the law of rigid contacts with a compliance: u_n' + g/T + r_n/(h kn T) with T = h + c/kn takes
  // the place of u_n' + c_n, and u_t' + (r_t - r_t of the last step)/(h^2 kt) that of u_t'.
  void add_springs(const StepSetting          &setting,
                   const std::vector<Contact> &contacts,
                   const std::vector<Impulse> &last,
                   ContactProblem             &problem);

  // Work of the contacts with springs at their bounds: force x the displacement that the springs do not take. `v`: end of step.
  std::vector<BoundWork> work_at_bounds(const ContactProblem            &problem,
                                        const std::vector<BodyVelocity> &v,
                                        const std::vector<Impulse>      &impulses);

  inline Eigen::Vector2d impulse_vector(const Contact &c, const Impulse &r)
  {
    return {c.normal.x() * r.normal - c.normal.y() * r.tangential, c.normal.y() * r.normal + c.normal.x() * r.tangential};
  }

  // Share of its penetration that a closed contact removes within the step through its normal term.
  double corrected_share(const StepOptions &stepping);

  // Coefficients of a contact with body j.
  struct Friction
  {
    double sliding, rolling;
  };
  Friction friction_of(const State &state, const StepSetting &setting, int body_j);

  // R of a contact: 1/R = 1/r_i + 1/r_j, or the radius of a grain on a wall. [length]
  double effective_radius(const Grains &grains, int i, int j);

  // Impulse of the couple on the first body, counter-clockwise. [pressure x length^2 x time]
  double couple_impulse(const Grains &grains, const Contact &c, const Impulse &r);
} // namespace diptych::discrete
