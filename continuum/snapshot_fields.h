// diptych: the one list of what a snapshot of the continuum holds, as files and readers of files take it
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "continuum/snapshot.h"

namespace diptych::continuum
{
  // Each calls visit(name, member, unit, meaning). Names are those of the datasets below a stage's group of continuum.h5. Vectors
  // are stored with three components (z = 0), tensors with nine, row by row; row = component of the force, column = normal of
  // the face. Stress and strain are positive in compression, angles anticlockwise.

  // Of the nodes. `rotation` is empty unless the law has rotations.
  template <class AnySnapshot, class Visit> void visit_node_fields(AnySnapshot &s, Visit &&visit)
  {
    visit("nodes/position", s.position, "length", "current place");
    visit("nodes/displacement", s.displacement, "length", "since the start");
    visit("nodes/rotation", s.rotation, "rad", "Cosserat rotation since the start; Cosserat laws only");
    visit("nodes/weight", s.weight, "length^2", "lumped area; the sum is the current area");
  }

  // Of one cell, means by area.
  template <class AnyCell, class Visit> void visit_cell_fields(AnyCell &c, Visit &&visit)
  {
    visit("cells/stress", c.stress, "pressure", "Cauchy stress");
    visit("cells/strain", c.strain, "-", "total strain, linearised on the initial shape");
    visit("cells/plastic_strain", c.plastic_strain, "-", "sum of increments");
    visit("cells/couple_stress", c.couple_stress, "pressure length", "m_x, m_y, mechanics sign");
    visit("cells/area", c.area, "length^2", "current area");
    visit("cells/equivalent_plastic_strain", c.equivalent_plastic_strain, "-",
          "hardening variable: integral of d(eps_1 - eps_3) plastic");
    visit("cells/dissipation", c.dissipation, "pressure", "plastic work per area since the start");
    visit("cells/overstress", c.overstress, "pressure", "part of the yield function that viscosity carries");
    visit("cells/share_zz_not_intermediate", c.share_zz_not_intermediate, "-",
          "share of the points where the stress out of the plane is an outer principal one");
    visit("cells/acoustic_determinant", c.acoustic_determinant, "-", "least det(n C n) relative to the elastic one");
    visit("cells/localisation_angle", c.localisation_angle, "degrees", "of the line that could form, from the horizontal");
    visit("cells/friction_angle", c.friction_angle, "degrees", "of the law at its state; elastic: 0");
    visit("cells/solid_fraction", c.solid_fraction, "-", "of a critical-state law; any other: 0");
  }

  // Attributes of the stage's group.
  template <class AnySnapshot, class Visit> void visit_attributes(AnySnapshot &s, Visit &&visit)
  {
    visit("axial_strain", s.axial_strain, "-", "descent of the upper platen / initial height");
    visit("time", s.time, "time", "since the start of the loading");
    visit("area", s.area, "length^2", "of the sample");
    visit("lower_platen_force", s.lower_platen_force, "pressure length", "on the sample");
    visit("upper_platen_force", s.upper_platen_force, "pressure length", "on the sample");
    visit("mean_stress", s.mean_stress, "pressure", "over the area");
    visit("shear_strain", s.shear_strain, "-", "travel of the upper platen to the right / initial height");
    visit("progress", s.progress, "as walk says", "what the loading has walked along its path");
    visit("walk", s.walk, "-", "which attribute progress equals: axial_strain, shear_strain or time");
  }

  constexpr const char *cells_name    = "cells/nodes";
  constexpr const char *cells_meaning = "nodes of an element: corners anticlockwise, middles of the edges from the first, centre";
} // namespace diptych::continuum
