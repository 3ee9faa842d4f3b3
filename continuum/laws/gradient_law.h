// diptych: plasticity with a nonlocal hardening variable and hence an internal length
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "continuum/laws/cone_law.h"

namespace diptych::continuum
{
  // Implicit gradient of the hardening variable kappa (Engelen, Geers, Baaijens, Int. J. Plast. 19, 2003). The nonlocal variable
  // kbar is an unknown of the element,
  //   (kbar - kappa) - l^2 laplace(kbar) = 0,  d kbar/dn = 0 on the boundary,
  // counted from the state at rest, where kbar = kappa. Strength and dilatancy that fall do so with
  //   max(0, (1 - m) kappa + m kbar),  m = nonlocal_weight.
  // With m = 1 a band may still be infinitely thin. With m > 1 the law hardens at a constant kbar (over-nonlocal: Vermeer and
  // Brinkgreve 1994; Stroemberg and Ristinmaa 1996; Di Luzio and Bazant 2005). A uniform shear layer then has a plastic zone of
  //   2 a (pi - atan(l/a)),  a = l sqrt(m - 1), and a half-maximum width of 2 a acos((1 - sqrt(1 - 1/m))/2);  m = 4: 9.1 l, 5.2
  //   l.
  // The scale s of the equation is the shear modulus. ElasticModuli has s as `skew` and s l^2 as `couple`.
  class GradientLaw : public ConeLaw
  {
  public:
    GradientLaw(const LawOptions &options, ConeShape shape);

    MaterialUpdate update(const MaterialState &s0, const Strain &d_strain, double d_time) const;

  private:
    void add_nonlocal_part(const Trial &trial, const ConeReturn &end, MaterialUpdate &answer) const;
  };

  // Tangent of the strains of the plane where kbar follows kappa, as in a uniform deformation: component `nonlocal` condensed.
  Tangent uniform_tangent(const Tangent &tangent);
} // namespace diptych::continuum
