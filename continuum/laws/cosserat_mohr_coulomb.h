// diptych: in-plane Mohr-Coulomb plasticity with Cosserat rotations and hence an internal length
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "continuum/laws/cone_law.h"

namespace diptych::continuum
{
  // F = sqrt(t^2 + m.m/(2 l^2)) - s sin(phi) - c cos(phi) with t and s in the plane. The stress sigma_zz stays elastic and does
  // not enter the yield function. The law is therefore Mohr-Coulomb only where sigma_zz is the intermediate principal stress.
  // The panel reports the share of the area where it is not. The plastic curvature contributes to the hardening variable.
  class CosseratMohrCoulomb : public ConeLaw
  {
  public:
    static constexpr bool is_cosserat = true;

    explicit CosseratMohrCoulomb(const LawOptions &options, const Units &units = {})
        : ConeLaw(options, ConeShape::mohr_coulomb, is_cosserat, units)
    {}
  };
} // namespace diptych::continuum
