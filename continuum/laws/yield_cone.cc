// diptych: Mohr-Coulomb and Drucker-Prager as cones over the pressure
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/yield_cone.h"

#include <cmath>

namespace diptych::continuum
{
  namespace
  {
    // 3 beta = sqrt3 D / w with D = sin psi and w = sqrt(3 + D^2).
    Dilation drucker_prager_dilation(const Dilation &d)
    {
      const double w = std::sqrt(3 + d.sine * d.sine);
      return {std::sqrt(3.) * d.sine / w, 3 * std::sqrt(3.) * d.rate / (w * w * w)};
    }
  } // namespace

  Cone mohr_coulomb_cone(const StrengthBySines &s)
  {
    return {s.friction,
            s.friction_rate,
            s.cohesion * s.friction_cosine,
            s.cohesion_rate * s.friction_cosine - s.cohesion * s.friction * s.friction_rate / s.friction_cosine,
            s.dilatancy,
            s.dilatancy_rate};
  }

  // With S = sin phi, D = sin psi and w = sqrt(3 + D^2): 3 beta = sqrt3 D / w and sqrt(1 - 3 beta^2) = sqrt3 / w, hence
  //   3 alpha = sqrt3 w S / (3 + S D),  k = c cos phi (1 - S D/(3 + S D)) w/sqrt3 = sqrt3 w c cos phi / (3 + S D).
  Cone drucker_prager_cone(const StrengthBySines &s)
  {
    const double   S = s.friction, D = s.dilatancy, w = std::sqrt(3 + D * D), w_rate = D * s.dilatancy_rate / w;
    const double   n = 3 + S * D, n_rate = s.friction_rate * D + S * s.dilatancy_rate;
    const double   factor = std::sqrt(3.) * w / n, factor_rate = std::sqrt(3.) * (w_rate - w * n_rate / n) / n;
    const double   c_cos      = s.cohesion * s.friction_cosine;
    const double   c_cos_rate = s.cohesion_rate * s.friction_cosine - s.cohesion * S * s.friction_rate / s.friction_cosine;
    const Dilation dilation   = drucker_prager_dilation({D, s.dilatancy_rate});
    return {factor * S,     factor_rate * S + factor * s.friction_rate,
            factor * c_cos, factor_rate * c_cos + factor * c_cos_rate,
            dilation.sine,  dilation.rate};
  }

  Cone YieldCone::over(const HardeningState &start, const double multiplier) const
  {
    const HardeningState end  = hardening.after(start, multiplier);
    Cone                 c    = at(end);
    const auto           mean = hardening.mean_dilation(start, end, multiplier);
    if (!mean)
      return c;
    const Dilation d = shape == ConeShape::mohr_coulomb ? *mean : drucker_prager_dilation(*mean);
    c.dilation       = d.sine;
    c.dilation_rate  = d.rate;
    return c;
  }

  double YieldCone::least_dilation() const
  {
    const Dilation least{hardening.least_dilation(), 0};
    return (shape == ConeShape::mohr_coulomb ? least : drucker_prager_dilation(least)).sine;
  }
} // namespace diptych::continuum
