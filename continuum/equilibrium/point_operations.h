// diptych: operations on elements and points: gather, scatter, rotate
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <vector>

#include "continuum/elements/discretisation.h"
#include "continuum/elements/element_kernels.h"
#include "continuum/laws/any_law.h"

namespace diptych::continuum
{
  template <class Element> ElementVector<Element> gather(const Cell &cell, const std::vector<double> &values)
  {
    ElementVector<Element> u;
    for (unsigned int i = 0; i < Element::n_dofs; ++i)
      u[i] = values[cell.local[i]];
    return u;
  }

  template <class Element> void scatter(const Cell &cell, const ElementVector<Element> &force, std::vector<double> &values)
  {
    for (unsigned int i = 0; i < Element::n_dofs; ++i)
      values[cell.local[i]] += force[i];
  }

  // Rotates stress and couple stress by an angle. The skew part does not depend on the frame. The last components of a gradient
  // law are no couple stress and stay.
  inline void turn(Stress &t, const double angle, const bool is_gradient = false)
  {
    const double c = std::cos(angle), s = std::sin(angle);
    const double mean = (t[xx] + t[yy]) / 2, a = (t[xx] - t[yy]) / 2, b = t[xy];
    const double cos2 = c * c - s * s, sin2 = 2 * c * s;
    t[xx] = mean + a * cos2 - b * sin2;
    t[yy] = mean - a * cos2 + b * sin2;
    t[xy] = a * sin2 + b * cos2;
    if (is_gradient)
      return;
    const double mx = t[curvature_x], my = t[curvature_y];
    t[curvature_x] = c * mx - s * my;
    t[curvature_y] = s * mx + c * my;
  }

  // Rotates a state by the rotation of the material.
  inline void turn(MaterialState &point, const double angle, const bool is_gradient = false)
  {
    turn(point.stress, angle, is_gradient);
    turn(point.back_stress_ratio, angle);
  }

  // Tensors among the state variables of a law from a library, too.
  inline void turn(MaterialState &point, const double angle, const Law &law, const bool is_gradient)
  {
    turn(point, angle, is_gradient);
    if (const auto *library = std::get_if<LibraryLaw>(&law))
      library->turn_variables(point, angle);
  }
} // namespace diptych::continuum
