// diptych: Mohr-Coulomb plasticity in plane strain
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "continuum/laws/cone_law.h"
#include "continuum/laws/principal_return.h"

namespace diptych::continuum
{
  // F = t - s sin(phi) - c cos(phi), t and s of the two outer principal stresses, g = t - s sin(psi). If sigma_zz is the
  // intermediate stress after the in-plane return, that return is exact, because sigma_zz then is elastic. Otherwise the stress
  // returns in principal space: to the plane of the outer two stresses, an edge or the apex. The hardening variable grows by
  // the multiplier, which is the plastic d(eps_1 - eps_3); on an edge by the sum of both multipliers.
  class MohrCoulomb : public ConeLaw
  {
  public:
    explicit MohrCoulomb(const LawOptions &options)
        : ConeLaw(options, ConeShape::mohr_coulomb, false)
    {}

    // Regime::edge if two yield planes are active, Regime::plastic if one is, in the plane of deformation or not.
    MaterialUpdate update(const MaterialState &s0, const Strain &d_strain, double d_time) const;

    // These refer to the outer two of all three principal stresses.
    double yield_function(const MaterialState &state) const;
    double shear_strength(const MaterialState &state) const;

  private:
    ConeReturn plane_part(const Trial &trial, const PrincipalReturn &principal) const;
  };
} // namespace diptych::continuum
