// diptych: rotation of stresses and strains in the plane
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>

#include "continuum/laws/law.h"

namespace diptych::continuum
{
  // Turns a symmetric tensor anticlockwise by an angle with this cosine and sine. V: a number or a row of derivatives.
  template <class V> void turn_tensor(V &xx, V &yy, V &xy, const double cosine, const double sine)
  {
    const double cos2 = cosine * cosine - sine * sine, sin2 = 2 * cosine * sine;
    const V      mean = (xx + yy) / 2, half = (xx - yy) / 2, deviator = half * cos2 - xy * sin2;
    xy = half * sin2 + xy * cos2;
    xx = mean + deviator;
    yy = mean - deviator;
  }

  template <class V> void turn_vector(V &x, V &y, const double cosine, const double sine)
  {
    const V before = x;
    x              = cosine * before - sine * y;
    y              = sine * before + cosine * y;
  }

  // Turns stress and couple stress [radians]. The skew part does not depend on the frame. The last components of a gradient law
  // are no couple stress and stay.
  inline void turn(Stress &t, const double angle, const bool is_gradient = false)
  {
    const double c = std::cos(angle), s = std::sin(angle);
    turn_tensor(t[xx], t[yy], t[xy], c, s);
    if (!is_gradient)
      turn_vector(t[curvature_x], t[curvature_y], c, s);
  }
} // namespace diptych::continuum
