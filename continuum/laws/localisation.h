// diptych: loss of ellipticity of a tangent: where and in which direction a band can begin
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "continuum/laws/law.h"

namespace diptych::continuum
{
  // The acoustic tensor of a tangent C in the direction n is Q_jk(n) = n_i C_ijkl n_l; where det Q = 0 a strain increment may
  // jump across a line with the normal n (Hadamard; Rudnicki & Rice, J. Mech. Phys. Solids 23, 1975).
  struct Localisation
  {
    double determinant = 1; // least det Q over all directions / det Q of the elastic tangent [-]; <= 0: a band can begin
    double angle_deg   = 0; // of the LINE (perpendicular to n) from the horizontal, anticlockwise [degrees], (-90, 90]
  };

  // The least determinant over all directions n in the plane. `tangent` need not be symmetric (flow that is not associated);
  // `elastic` is isotropic, so that its determinant is the same in every direction. Both in the same unit. Only the block
  // xx, yy, xy counts, also of a Cosserat law: couple stress and skew stress keep that problem elliptic by themselves, and
  // the block is the law they regularise, whose loss of ellipticity marks the onset of a band.
  // A coaxial state has two minima that mirror each other in the principal axes: of two determinants that agree within
  // 1e-9 the larger angle is taken. Where no direction is distinguished, as in the elastic range, the angle is 0.
  // A tangent with a value that is not finite gives the determinant NaN.
  Localisation localisation(const Tangent &tangent, const Tangent &elastic);
} // namespace diptych::continuum
