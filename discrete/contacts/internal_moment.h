// diptych: Moreau's internal moment of every grain
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "discrete/snapshot.h"
#include "discrete/bodies/state.h"

namespace diptych::discrete
{
  // M_i = -sym(sum_c l_c f_c^T) - (1/2) J_i omega_i^2 Id, l_c = x_c - x_i, summed over the contacts c of grain i (Moreau 1997,
  // eq. 6). J_i is the moment of inertia and Id the identity. Positive in compression [pressure x length^2]. Forces that act at
  // the centre contribute nothing, nor do the couples of contacts: these only change the skew part. `spin_term` is (1/2) J_i
  // omega_i^2 of each grain, or its mean over a range of time.
  std::vector<Eigen::Matrix2d> internal_moments(const std::vector<Eigen::Vector2d> &position,
                                                const std::vector<ContactForce>    &forces,
                                                const std::vector<double>          &spin_term);

  // Moment about the centre before symmetrisation. Its skew part is half the unbalanced couple of the grain, couples of contacts
  // included.
  std::vector<Eigen::Matrix2d> raw_contact_moments(const std::vector<Eigen::Vector2d> &position,
                                                   const std::vector<ContactForce>    &forces);

  std::vector<double> spin_terms(const Grains &grains); // (1/2) J_i omega_i^2 of each grain

  // Invariants of a symmetric stress: s = (s1 + s2)/2, t = (s1 - s2)/2, t/s = sin of the mobilised friction angle.
  double stress_ratio(const Eigen::Matrix2d &stress);
} // namespace diptych::discrete
