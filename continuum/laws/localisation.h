// diptych: loss of ellipticity of a tangent, the onset of a band and its direction
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "continuum/laws/law.h"

namespace diptych::continuum
{
  // The acoustic tensor of a tangent C in the direction n is Q_jk(n) = n_i C_ijkl n_l; where det Q = 0 a strain increment may
  // jump across a line with the normal n (Hadamard; Rudnicki & Rice, J. Mech. Phys. Solids 23, 1975).
  struct Localisation
  {
    double determinant = 1; // least det Q over all directions / elastic det Q [-]; <= 0: a band can begin
    double angle_deg   = 0; // of the LINE (perpendicular to n) from the horizontal, anticlockwise [degrees], (-90, 90]
  };

  // The least determinant over all directions n in the plane. Both tangents have the same unit; `tangent` need not be
  // symmetric, and `elastic` is isotropic. Only the block xx, yy, xy enters, also for a Cosserat law. Its couple stress and
  // skew stress keep the problem elliptic; the classical block is the law that they regularise. A coaxial state has two minima,
  // symmetric about the principal axes. If they agree within 1e-9, the function returns the larger angle. The angle is 0 if no
  // direction is distinguished, as in the elastic range. The determinant is NaN if a value of the tangent is not finite.
  Localisation localisation(const Tangent &tangent, const Tangent &elastic);
} // namespace diptych::continuum
