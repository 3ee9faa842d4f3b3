// diptych: Mohr-Coulomb and Drucker-Prager as cones over the pressure
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/yield_cone.h"

#include <cmath>

namespace diptych::continuum
{
  Cone mohr_coulomb_cone(const Strength &strength)
  {
    const double sin_phi = std::sin(strength.friction), cos_phi = std::cos(strength.friction), c = strength.cohesion;
    return {sin_phi,
            cos_phi * strength.friction_rate,
            c * cos_phi,
            strength.cohesion_rate * cos_phi - c * sin_phi * strength.friction_rate,
            std::sin(strength.dilatancy),
            std::cos(strength.dilatancy) * strength.dilatancy_rate};
  }

  // With S = sin phi, D = sin psi and w = sqrt(3 + D^2): 3 beta = sqrt3 D / w and sqrt(1 - 3 beta^2) = sqrt3 / w, hence
  //   3 alpha = sqrt3 w S / (3 + S D),  k = c cos phi (1 - S D/(3 + S D)) w/sqrt3 = sqrt3 w c cos phi / (3 + S D).
  Cone drucker_prager_cone(const Strength &strength)
  {
    const double S = std::sin(strength.friction), cos_phi = std::cos(strength.friction);
    const double D = std::sin(strength.dilatancy), D_rate = std::cos(strength.dilatancy) * strength.dilatancy_rate;
    const double w = std::sqrt(3 + D * D), w_rate = D * D_rate / w;
    const double S_rate = cos_phi * strength.friction_rate, n = 3 + S * D, n_rate = S_rate * D + S * D_rate;
    const double factor = std::sqrt(3.) * w / n, factor_rate = std::sqrt(3.) * (w_rate - w * n_rate / n) / n;
    const double c_cos      = strength.cohesion * cos_phi;
    const double c_cos_rate = strength.cohesion_rate * cos_phi - strength.cohesion * S * strength.friction_rate;
    return {factor * S,
            factor_rate * S + factor * S_rate,
            factor * c_cos,
            factor_rate * c_cos + factor * c_cos_rate,
            std::sqrt(3.) * D / w,
            std::sqrt(3.) * (D_rate - D * w_rate / w) / w};
  }
} // namespace diptych::continuum
