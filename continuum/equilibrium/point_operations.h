// diptych: operations on elements and points: gather, scatter, rotate
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "continuum/elements/discretisation.h"
#include "continuum/elements/element_kernels.h"
#include "continuum/laws/rotation.h"
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

  // Rotates a state by the rotation of the material.
  inline void turn(MaterialState &point, const double angle, const bool is_gradient = false)
  {
    turn(point.stress, angle, is_gradient);
    if (auto *moving = std::get_if<KinematicState>(&point.own))
      turn(moving->back_stress_ratio, angle);
  }

  // Tensors among the state variables of a law from a library, too.
  inline void turn(MaterialState &point, const double angle, const Law &law, const bool is_gradient)
  {
    turn(point, angle, is_gradient);
    if (const auto *library = std::get_if<LibraryLaw>(&law))
      library->turn_variables(point, angle);
  }
} // namespace diptych::continuum
