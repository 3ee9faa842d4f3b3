// diptych: plastic strain and plastic work of a step
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "continuum/laws/elasticity.h"

namespace diptych::continuum
{
  // Adds the plastic flow of the step from s0 to s1 to the sums in s1: to s1.plastic_strain the increment
  //   d_strain - C^-1 (sigma_1 - sigma_0), out of the plane the strain is zero; and to s1.dissipation the plastic work
  //   sigma_1 : d eps_p + m . d kappa_p at the final stress.
  // Apart from round-off the work is not negative. The skew stress has no plastic part. On entry s1 must hold the sums of s0, as
  // after update().
  void add_plastic_flow(const ElasticModuli &moduli, const MaterialState &s0, const Strain &d_strain, MaterialState &s1);

  // Whether the second-order work (sigma_1 - sigma_0) : d eps is negative (Hill, J. Mech. Phys. Solids 6, 1958) while the
  // plastic flow from s0 to s1 contracts. Loose grains then collapse if nothing lets them dilate. Both states must hold their
  // plastic strain.
  bool weakens_contracting(const ElasticModuli &moduli, const MaterialState &s0, const Strain &d_strain, const MaterialState &s1);
} // namespace diptych::continuum
