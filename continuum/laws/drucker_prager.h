// diptych: Drucker-Prager plasticity in plane strain
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "continuum/laws/cone_law.h"

namespace diptych::continuum
{
  // F = sqrt(J2) + alpha I1 - k with alpha, k and the dilatancy matched to plane-strain flow (yield_cone.h). In such flow it has
  // the strength of the Mohr-Coulomb law for any dilatancy. sigma_zz flows plastically. The hardening variable grows by the
  // plastic multiplier, which is the norm of the plastic part of
  //   g = (e_xx - e_yy, gamma_xy, -tr(e)/sqrt3),
  // with the plane strain increment e (cone_law.h). In plane-strain flow the multiplier is the plastic d(eps_1 - eps_3) times
  // sqrt(1 + sin^2(psi)/3), which is 0.7 % larger at psi = 12 degrees.
  class DruckerPrager : public ConeLaw
  {
  public:
    static constexpr bool is_cosserat = false;

    explicit DruckerPrager(const LawOptions &options, const Units &units = {})
        : ConeLaw(options, ConeShape::drucker_prager, is_cosserat, units)
    {}
  };
} // namespace diptych::continuum
