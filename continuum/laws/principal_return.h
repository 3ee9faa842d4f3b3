// diptych: Mohr-Coulomb return mapping in principal space
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>

#include "continuum/laws/cone_return.h"
#include "continuum/laws/elasticity.h"

namespace diptych::continuum
{
  // Sorted principal stresses, tension positive: [0] >= [1] >= [2].
  using Principal = std::array<double, 3>;

  struct PrincipalReturn
  {
    Principal                stress{};
    std::array<Principal, 3> jacobian{}; // d stress / d trial stress
    double                   multiplier = 0, overstress = 0;
    Regime                   regime  = Regime::plastic;
    Verdict                  verdict = Verdict::reliable;
  };

  // Returns a trial stress from outside the yield surface to the plane of the two outer stresses. If that fails: to the edge
  // with stress[1] = stress[2], the edge with stress[0] = stress[1], or the apex. All yield planes share one hardening
  // variable, which grows by the sum of their multipliers, and one viscous overstress, viscous_modulus times that sum. Opening
  // at the apex does not harden. Method: de Souza Neto, Peric, Owen, Computational Methods for Plasticity (2008), chapter 8.
  // The difference of the two multipliers of an edge makes two trial stresses equal, so only their sum remains to be solved
  // for.
  PrincipalReturn return_in_principal_space(const YieldCone     &cone,
                                            const ElasticModuli &moduli,
                                            const ConeStart     &start,
                                            const Principal     &trial,
                                            double               viscous_modulus);
} // namespace diptych::continuum
