// diptych: Mohr-Coulomb and Drucker-Prager as cones over the pressure
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/yield_cone.h"

#include <cmath>

namespace diptych::continuum
{
  namespace
  {
    // 3 beta = sqrt3 D / w with D = sin psi and w = sqrt(3 + D^2).
    Rated drucker_prager_dilation(const Rated &d)
    {
      const double w = std::sqrt(3 + d.value * d.value);
      return {std::sqrt(3.) * d.value / w, 3 * std::sqrt(3.) * d.rate / (w * w * w)};
    }

    // c cos phi
    Rated intercept_of(const StrengthBySines &s)
    {
      const Rated &c = s.cohesion, &S = s.friction;
      return {c.value * s.friction_cosine, c.rate * s.friction_cosine - c.value * S.value * S.rate / s.friction_cosine};
    }
  } // namespace

  Cone mohr_coulomb_cone(const StrengthBySines &s)
  {
    return {s.friction, intercept_of(s), s.dilatancy};
  }

  // With S = sin phi, D = sin psi and w = sqrt(3 + D^2): 3 beta = sqrt3 D / w and sqrt(1 - 3 beta^2) = sqrt3 / w, hence
  //   3 alpha = sqrt3 w S / (3 + S D),  k = c cos phi (1 - S D/(3 + S D)) w/sqrt3 = sqrt3 w c cos phi / (3 + S D).
  Cone drucker_prager_cone(const StrengthBySines &s)
  {
    const double S = s.friction.value, D = s.dilatancy.value, w = std::sqrt(3 + D * D), w_rate = D * s.dilatancy.rate / w;
    const double n = 3 + S * D, n_rate = s.friction.rate * D + S * s.dilatancy.rate;
    const double factor = std::sqrt(3.) * w / n, factor_rate = std::sqrt(3.) * (w_rate - w * n_rate / n) / n;
    const auto scaled = [&](const Rated &one) { return Rated{factor * one.value, factor_rate * one.value + factor * one.rate}; };
    return {scaled(s.friction), scaled(intercept_of(s)), drucker_prager_dilation(s.dilatancy)};
  }

  Cone YieldCone::over(const HardeningState &start, const double multiplier) const
  {
    const HardeningState end  = hardening.after(start, multiplier);
    Cone                 c    = at(end);
    const auto           mean = hardening.mean_dilation(start, end, multiplier);
    if (!mean)
      return c;
    c.dilation = shape == ConeShape::mohr_coulomb ? *mean : drucker_prager_dilation(*mean);
    return c;
  }

  double YieldCone::least_dilation() const
  {
    const Rated least{hardening.least_dilation(), 0};
    return (shape == ConeShape::mohr_coulomb ? least : drucker_prager_dilation(least)).value;
  }
} // namespace diptych::continuum
