// diptych: Mohr-Coulomb and Drucker-Prager as cones over the pressure
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "continuum/laws/hardening.h"

namespace diptych::continuum
{
  // F = |q| - s slope - intercept, with the pressure s (positive in compression) and a deviatoric vector q. The plastic volume
  // strain is `dilation` times the plastic multiplier.
  struct Cone
  {
    Rated slope;
    Rated intercept; // [pressure]
    Rated dilation;
  };

  // slope = sin phi, intercept = c cos phi, dilation = sin psi.
  Cone mohr_coulomb_cone(const StrengthBySines &strength);

  // slope = 3 alpha, intercept = k, dilation = 3 beta of F = sqrt(J2) + alpha I1 - k and G = sqrt(J2) + beta I1. They are
  // matched to phi, psi and c in plane-strain flow, for any psi:
  //   beta  = sin psi / sqrt(9 + 3 sin^2 psi),  alpha = sin phi / (3 (sqrt(1 - 3 beta^2) + beta sin phi)),
  //   k     = c cos phi (1 - 3 alpha beta) / sqrt(1 - 3 beta^2).
  Cone drucker_prager_cone(const StrengthBySines &strength);

  struct YieldCone
  {
    Hardening hardening;
    ConeShape shape;

    Cone at(const double equivalent_plastic_strain) const { return at(HardeningState{equivalent_plastic_strain}); }
    Cone at(const HardeningState &state) const { return of(hardening.sines_at(state)); }
    // Gradient laws: the rates are derivatives by the nonlocal hardening variable.
    Cone by_nonlocal(const HardeningState &state) const { return of(hardening.sines_by_nonlocal(state)); }
    Cone of(const StrengthBySines &s) const
    {
      return shape == ConeShape::mohr_coulomb ? mohr_coulomb_cone(s) : drucker_prager_cone(s);
    }
    // The cone at the end of a step, with the mean dilation over that step.
    Cone over(const HardeningState &start, double multiplier) const;
    // A lower bound of the dilation at any state.
    double least_dilation() const;
  };
} // namespace diptych::continuum
