// diptych: strength at one state of the hardening
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "continuum/require.h"

namespace diptych::continuum
{
  constexpr double one_degree = 3.14159265358979323846 / 180;

  inline double cosine(const double sine)
  {
    return std::sqrt((1 - sine) * (1 + sine));
  }

  // A value with its derivative by the hardening variable.
  struct Rated
  {
    double value = 0, rate = 0;
  };

  // Strength at one value of the hardening variable.
  struct Strength
  {
    Rated friction, dilatancy; // phi, psi [radians]
    Rated cohesion;            // c [pressure]
  };

  // Strength with the sines of the angles in place of the angles.
  struct StrengthBySines
  {
    Rated  friction, dilatancy; // sin phi, sin psi
    Rated  cohesion;            // c [pressure]
    double friction_cosine = 1; // cos phi
  };

  // The part of a MaterialState on which the strength depends.
  struct HardeningState
  {
    double equivalent_plastic_strain = 0;
    double stress_ratio_gain = 0, densification = 0; // critical state: change since the start
    double nonlocal_plastic_strain = 0;              // gradient laws
  };

  // Strength as a scene gives it, for one value of the hardening variable.
  struct StrengthPoint
  {
    double friction = 0, dilatancy = 0, cohesion = 0; // [radians, radians, pressure]
  };
  inline Strength constant(const StrengthPoint &p)
  {
    return {{p.friction, 0}, {p.dilatancy, 0}, {p.cohesion, 0}};
  }

  // Throws WrongKeys unless dilatancy <= friction [degrees] and friction or cohesion is positive. `place`: "at the peak".
  inline void check_strength(const std::string              &place,
                             const std::vector<std::string> &keys,
                             const double                    friction,
                             const double                    dilatancy,
                             const double                    cohesion)
  {
    require_keys(dilatancy <= friction, keys, "dilatancy angle ", dilatancy, ' ', place, " must not exceed the friction angle ",
                 friction, " (plastic work would be negative)");
    require_keys(friction > 0 || cohesion > 0, keys, "friction and cohesion are both zero ", place, ": one must be positive");
  }
} // namespace diptych::continuum
