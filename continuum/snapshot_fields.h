// diptych: datasets and attributes of a snapshot of the continuum
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "continuum/snapshot.h"

namespace diptych::continuum
{
  // Each function calls visit(name, member, unit, meaning). The names are those of the datasets in a stage's group of
  // continuum.h5. Vectors are stored with three components (z = 0), tensors with nine, row by row. The row is the component of
  // the force, the column the normal of the face. Stress and strain are positive in compression, angles anticlockwise.

  // Fields at the nodes. `rotation` is empty unless the law has rotations.
  template <class AnySnapshot, class Visit> void visit_node_fields(AnySnapshot &s, Visit &&visit)
  {
    visit("nodes/position", s.position, "length", "current position");
    visit("nodes/displacement", s.displacement, "length", "displacement since the start");
    visit("nodes/rotation", s.rotation, "rad", "Cosserat rotation since the start; Cosserat laws only");
    visit("nodes/weight", s.weight, "length^2", "lumped area; the sum is the current area");
    visit("nodes/platen_force", s.platen_force, "pressure length", "force of a platen on the node; 0 elsewhere");
  }

  template <class AnyCell, class Visit> void visit_cell_fields(AnyCell &c, Visit &&visit)
  {
    visit("cells/stress", c.stress, "pressure", "Cauchy stress");
    visit("cells/strain", c.strain, "-", "total strain, linearised on the initial shape");
    visit("cells/plastic_strain", c.plastic_strain, "-", "sum of the plastic increments");
    visit("cells/couple_stress", c.couple_stress, "pressure length",
          "couple stresses m_x and m_y in the sign convention of mechanics");
    visit("cells/area", c.area, "length^2", "current area");
    visit("cells/equivalent_plastic_strain", c.equivalent_plastic_strain, "-",
          "hardening variable: integral of the plastic d(eps_1 - eps_3)");
    visit("cells/dissipation", c.dissipation, "pressure", "plastic work per area since the start");
    visit("cells/overstress", c.overstress, "pressure", "part of the yield function that viscosity carries");
    visit("cells/share_zz_not_intermediate", c.share_zz_not_intermediate, "-",
          "share of the points where the out-of-plane stress is not the intermediate principal stress");
    visit("cells/acoustic_determinant", c.acoustic_determinant, "-",
          "least determinant det(n C n) of the acoustic tensor, relative to the elastic one");
    visit("cells/localisation_angle", c.localisation_angle, "degrees", "angle of the band that could form, from the horizontal");
    visit("cells/friction_angle", c.friction_angle, "degrees",
          "friction angle of the law at its current state; 0 for linear_elastic");
    visit("cells/solid_fraction", c.solid_fraction, "-",
          "solid fraction if hardening = critical_state or kinematic, otherwise 0");
    visit("cells/nonlocal_plastic_strain", c.nonlocal_plastic_strain, "-",
          "nonlocal hardening variable of a gradient law, otherwise 0");
  }

  template <class AnySnapshot, class Visit> void visit_attributes(AnySnapshot &s, Visit &&visit)
  {
    visit("axial_strain", s.axial_strain, "-", "descent of the upper platen / initial height");
    visit("time", s.time, "time", "since the start of the loading");
    visit("area", s.area, "length^2", "current area of the sample");
    visit("lower_platen_force", s.lower_platen_force, "pressure length", "force of the lower platen on the sample");
    visit("upper_platen_force", s.upper_platen_force, "pressure length", "force of the upper platen on the sample");
    visit("mean_stress", s.mean_stress, "pressure", "mean stress over the area");
    visit("shear_strain", s.shear_strain, "-", "travel of the upper platen to the right / initial height");
    visit("progress", s.progress, "strain or time", "loading variable: axial strain, shear strain or time");
    visit("walk", s.loading_variable, "-", "attribute that progress equals: axial_strain, shear_strain or time");
  }

  constexpr const char *cells_name = "cells/nodes";
  constexpr const char *cells_meaning =
    "nodes of an element: corners anticlockwise, then midpoints of the edges from the first on, then the centre";
} // namespace diptych::continuum
