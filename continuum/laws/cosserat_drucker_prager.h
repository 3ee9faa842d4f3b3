// diptych: Drucker-Prager plasticity with Cosserat rotations and hence an internal length
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "continuum/laws/cone_law.h"

namespace diptych::continuum
{
  // As DruckerPrager, but the couple stress enters the yield function: J2 + m.m/(2 l^2) in place of J2. The plastic curvature
  // contributes to the hardening variable.
  class CosseratDruckerPrager : public ConeLaw
  {
  public:
    static constexpr bool is_cosserat = true;

    explicit CosseratDruckerPrager(const LawOptions &options, const Units &units = {})
        : ConeLaw(options, ConeShape::drucker_prager, is_cosserat, units)
    {}
  };
} // namespace diptych::continuum
