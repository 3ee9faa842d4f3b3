// diptych: inclinations of a shear band by theory
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

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
} // namespace diptych::coupling
