// diptych: Mohr-Coulomb return mapping in principal space
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>

#include "continuum/laws/cone_return.h"
#include "continuum/laws/elasticity.h"

namespace diptych::continuum
{
  // Principal stresses sorted, tension positive: [0] >= [1] >= [2].
  using Principal = std::array<double, 3>;

  struct PrincipalReturn
  {
    Principal                stress{};
    std::array<Principal, 3> jacobian{}; // d stress / d trial stress
    double                   multiplier = 0, overstress = 0;
    Regime                   regime  = Regime::plastic;
    Verdict                  verdict = Verdict::reliable;
  };

  // Return of a trial outside the yield surface to the plane of the outer two stresses, else to the edge with
  // stress[1] = stress[2] or that with stress[0] = stress[1], else to the apex. All yield planes share one hardening variable,
  // which grows by the sum of their multipliers, and one viscous overstress, viscous_modulus times that sum. Opening at the apex
  // does not harden. Method: de Souza Neto, Peric, Owen, Computational Methods for Plasticity (2008), chapter 8; since the two
  // multipliers of an edge differ by what makes two trial stresses meet, only their sum is left to be solved for.
  PrincipalReturn return_in_principal_space(const YieldCone      &cone,
                                            const ElasticModuli  &moduli,
                                            const HardeningState &start,
                                            const Principal      &trial,
                                            double                viscous_modulus);
} // namespace diptych::continuum
