// diptych: plastic strain and plastic work of a step
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "continuum/laws/elasticity.h"

namespace diptych::continuum
{
  // Adds to s1.plastic_strain what the stress change from s0 to s1 leaves of `d_strain`: d_strain - C^-1 (sigma_1 - sigma_0),
  // out of the plane the strain is zero; and to s1.dissipation the plastic work sigma_1 : d eps_p + m . d kappa_p at the stress
  // of the end, not negative but for round-off. The skew stress has no plastic part. s1 must hold s0's sums, as update() leaves
  // them.
  void add_plastic_flow(const ElasticModuli &moduli, const MaterialState &s0, const Strain &d_strain, MaterialState &s1);

  // Whether the second-order work (sigma_1 - sigma_0) : d eps is negative (Hill, J. Mech. Phys. Solids 6, 1958) while the plastic
  // flow from s0 to s1 contracts: loose grains that collapse where nothing lets them dilate. Both with their plastic flow.
  bool weakens_contracting(const ElasticModuli &moduli, const MaterialState &s0, const Strain &d_strain, const MaterialState &s1);
} // namespace diptych::continuum
