// diptych: inclinations of a shear band by theory
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cmath>
#include <stdexcept>

namespace diptych::coupling
{
  // Angle between a band and the direction of the minor principal stress (smallest compression) [degrees]. The two conjugate
  // bands lie at this angle on either side of it. Observed bands lie between Roscoe's and Coulomb's line (Vardoulakis & Sulem
  // 1995), so the theories give a range.
  struct TheoryLines
  {
    double coulomb_deg = 45; // 45 + phi/2: plane of greatest stress obliquity
    double roscoe_deg  = 45; // 45 + psi/2: line of no extension (Roscoe 1970)
    double arthur_deg  = 45; // 45 + (phi + psi)/4 (Arthur, Dunstan, Al-Ani & Assadi 1977)
  };

  // Friction angle phi in [0, 90), dilatancy angle psi in (-90, 90), positive if the material dilates [degrees]. Throws
  // std::invalid_argument outside these ranges.
  inline TheoryLines theory_lines(const double friction_deg, const double dilatancy_deg)
  {
    if (!(friction_deg >= 0 && friction_deg < 90))
      throw std::invalid_argument("theory lines need a friction angle from 0 to below 90 degrees");
    if (!(dilatancy_deg > -90 && dilatancy_deg < 90))
      throw std::invalid_argument("theory lines need a dilatancy angle between -90 and 90 degrees");
    return {45 + friction_deg / 2, 45 + dilatancy_deg / 2, 45 + (friction_deg + dilatancy_deg) / 4};
  }

  // The two conjugate bands at such an angle to the minor principal direction, as angles from the horizontal in (-90, 90]
  // [degrees]. The band turned counter-clockwise comes first.
  inline std::array<double, 2> conjugate_angles_deg(const double to_minor_deg, const double minor_direction_deg)
  {
    const auto folded = [](const double angle) { return 90 - std::fmod(std::fmod(90 - angle, 180.) + 180, 180.); };
    return {{folded(minor_direction_deg + to_minor_deg), folded(minor_direction_deg - to_minor_deg)}};
  }
} // namespace diptych::coupling
