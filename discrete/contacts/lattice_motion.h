// diptych: motion of a lattice under its drive and the impulses of contacts
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "discrete/bodies/state.h"
#include "discrete/contacts/contact_problem.h"

namespace diptych::discrete
{
  // The lattice is a body with three velocities, the rate q = (exx, eyy, 2 exy) of the strain. Grain i moves at V_i + L(q) x_i
  // and the image of j at the shift a moves at V_j + L(q) (x_j + a), L the velocity gradient. A contact with branch l = x_i - x_j
  // - a and impulse r therefore enters the balance of the lattice with its moment r l^T. With A the area of the lattice, h the
  // step, S = (Sxx, Syy, Sxy) the sum of the moments, M the inertia and a prime for the end of the step
  //   M (q' - q) + S = h A (stress that drives the cell).
  // Each control prescribes either a form of q' or the same form of this stress. V_i does not depend on the choice of images, so
  // no place of the cell differs from another. (Parrinello & Rahman 1981; for contact dynamics Radjai, C. R. Mecanique 346,
  // 2018.)

  // Inertia of the strains: mass x diameter^2 of the grains, with the ratios of an isotropic elastic response. With less
  // than half of it, over-relaxed sweeps and the lattice excite each other in dense packings.
  Eigen::Matrix3d lattice_inertia(const Grains &grains);

  struct LatticeMotion
  {
    Eigen::Vector3d free_rate; // without impulses
    Eigen::Matrix3d mobility;
  };

  // For a step that began at `time`; the lattice is at mid-step.
  LatticeMotion lattice_motion(const Lattice &lattice, double time, double step);

  // Rate at time 0 of prescribed strains; the other components have it as if stresses stayed constant in an elastic material.
  Eigen::Vector3d start_rate(const LatticeDrive &drive);

  inline Eigen::Vector3d rate_of(const BodyVelocity &record)
  {
    return {record.x, record.y, record.surface};
  }

  inline BodyVelocity record_of(const Eigen::Vector3d &rate)
  {
    return {rate[0], rate[1], rate[2], 0};
  }

  // Adds gradient x place to the velocities of grains and lattice vectors.
  void add_gradient(const std::vector<Eigen::Vector2d> &place, const Eigen::Matrix2d &gradient, std::vector<BodyVelocity> &v);

  // Shift of the image of a row, 0 within the cell.
  inline Eigen::Vector2d shift_of(const ContactRow &c, const LatticeProblem &lattice)
  {
    const std::size_t a1 = lattice.place.size() - 2;
    return c.image_body < 0 ? Eigen::Vector2d(Eigen::Vector2d::Zero())
                            : Eigen::Vector2d(c.image.along * lattice.place[a1] + c.image.upward * lattice.place[a1 + 1]);
  }

  inline Eigen::Vector2d vector_of(const ContactRow &c, const Impulse &r)
  {
    return {c.nx * r.normal - c.ny * r.tangential, c.ny * r.normal + c.nx * r.tangential};
  }

  inline Eigen::Matrix2d crossing_of(const ContactRow &c, const Impulse &r, const LatticeProblem &lattice)
  {
    return vector_of(c, r) * shift_of(c, lattice).transpose();
  }

  // Sets the rate that follows from the impulses which `v` contains, and moves grains and lattice along. `free`: the velocities
  // without impulses. `crossing`: sum of impulse x shift^T over all rows.
  void follow_crossing(const LatticeProblem            &lattice,
                       const std::vector<BodyVelocity> &free,
                       const Eigen::Matrix2d           &crossing,
                       std::vector<BodyVelocity>       &v);

  // As follow_crossing(), with the sum over the impulses of all rows. Does nothing without a lattice.
  void follow_impulses(const ContactProblem            &problem,
                       const std::vector<BodyVelocity> &free,
                       const std::vector<Impulse>      &impulses,
                       std::vector<BodyVelocity>       &v);
} // namespace diptych::discrete
