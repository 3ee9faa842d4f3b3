// diptych: Mohr-Coulomb plasticity in plane strain
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "continuum/laws/cone_law.h"
#include "continuum/laws/principal_return.h"

namespace diptych::continuum
{
  // F = t - s sin(phi) - c cos(phi), t and s of the two outer principal stresses, g = t - s sin(psi). Where sigma_zz is
  // intermediate after it, the in-plane return is exact: sigma_zz is elastic there. Else the return is done in principal
  // space, on the plane of the outer two stresses, on an edge where two planes meet, or at the apex.
  // The hardening variable grows by the multiplier, which is d(eps_1 - eps_3) plastic, on an edge by the sum of both.
  class MohrCoulomb : public ConeLaw
  {
  public:
    static constexpr bool is_cosserat = false;

    explicit MohrCoulomb(const LawOptions &options, const Units &units = {})
        : ConeLaw(options, ConeShape::mohr_coulomb, is_cosserat, units)
    {}

    // Regime::edge where two planes answer; Regime::plastic where one does, be it in the plane of deformation or not.
    MaterialUpdate update(const MaterialState &s0, const Strain &d_strain, double d_time) const;

    // Of the outer two of all three principal stresses.
    double yield_function(const MaterialState &state) const;
    double shear_strength(const MaterialState &state) const;

  private:
    ConeReturn plane_part(const Trial &trial, const PrincipalReturn &principal) const;
  };
} // namespace diptych::continuum
