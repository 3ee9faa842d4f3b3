// diptych: the only list of the fields of a grain snapshot, used by all readers and writers of files
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "discrete/meaning.h"
#include "discrete/snapshot.h"

namespace diptych::discrete
{
  // Each function calls visit(name, member, unit, meaning). The names are those of the datasets in a stage's group of
  // discrete.h5. Vectors are stored with three components (z = 0) and tensors with nine, row by row; the row is the component of
  // the force. Stress-like quantities are positive in compression and angles anticlockwise. All quantities are per unit
  // thickness.

  template <class AnySnapshot, class Visit> void visit_grain_fields(AnySnapshot &s, Visit &&visit)
  {
    visit("grains/position", s.position, "length", "position of the centre");
    visit("grains/displacement", s.displacement, "length", "displacement of the centre since the start of the loading");
    visit("grains/velocity", s.velocity, "length/time", "velocity of the centre");
    visit("grains/rotation", s.rotation, "rad", "rotation since the start of the loading");
    visit("grains/spin", s.spin, "rad/time", "angular velocity");
    visit("grains/radius", s.radius, "length", "radius");
    visit("grains/mass", s.mass, "mass", "mass");
    visit("grains/internal_moment", s.internal_moment, "pressure length^2",
          "internal moment in the last step, spin term included");
    visit("grains/mean_internal_moment", s.mean_internal_moment, "pressure length^2",
          "internal moment of the mean contact forces of the stage, mean spin term included");
    visit("grains/mean_spin_term", s.mean_spin_term, "pressure length^2",
          "mean over the stage of (1/2) J omega^2 (J: moment of inertia), which the internal moment contains with a minus sign");
    visit("grains/rattler", s.rattler, "-", "1 if the grain carries no contact force");
    visit("grains/fixed", s.fixed, "-",
          "1 if the grain is held at its velocity, 2 or 3 if it is part of the lower or upper platen");
    visit("grains/applied_force", s.applied_force, "pressure length",
          "force of the lateral action and of gravity in the last step");
  }

  // Fields of one entry of a list of contacts. The pair of bodies is stored separately.
  template <class AnyContact, class Visit> void visit_contact_fields(AnyContact &c, Visit &&visit)
  {
    visit("point", c.point, "length", "contact point");
    visit("normal", c.normal, "-", "unit vector from the second body to the first");
    visit("force", c.force, "pressure length", "force on the first body");
    visit("image_shift", c.shift, "length",
          "x of the touching image of the second body minus x of that body; not 0 only across the edge of a periodic cell");
    visit("image_shift_y", c.shift_y, "length",
          "y of that image minus y of the second body; not 0 only in a cell that is periodic in both directions");
    visit("couple", c.couple, "pressure length^2", "couple of rolling resistance on the first body, counter-clockwise");
  }
  inline constexpr char contact_bodies[] =
    "two body numbers per contact: grains count from 0, walls from the number of grains on";

  template <class AnySnapshot, class Visit> void visit_contact_lists(AnySnapshot &s, Visit &&visit)
  {
    visit(
      "contacts", s.contacts, "",
      "candidate contacts of the last step; open ones carry no force. A step computes forces at its middle: they balance about "
      "points and normals there, while those stored belong to the end of the step, like the grains");
    visit("window", s.window_forces, "",
          "mean force (sum of impulses / time) of every pair that touched since the previous stage");
  }

  // Values with one entry per contact of these lists.
  template <class AnySnapshot, class Visit> void visit_contact_values(AnySnapshot &s, Visit &&visit)
  {
    visit("contacts/gap", s.gap, "length", "distance of the surfaces; negative: penetration");
    visit("contacts/status", s.status, "-", "0 open, 1 sticking, 2 slipping, 3 unknown (imported)");
    visit("window/dissipation", s.window_dissipation, "pressure length^2",
          "dissipation by friction and rolling resistance, summed over the steps of the stage");
    visit("window/impact_dissipation", s.window_impact_dissipation, "pressure length^2",
          "dissipation along the normal, summed over the steps of the stage");
  }
  inline constexpr char contact_impulses[] = "normal and tangential impulse of the last step on the first body";

  template <class AnySnapshot, class Visit> void visit_outline(AnySnapshot &s, Visit &&visit)
  {
    visit("outline/left", s.outline.left, "length", "left side of the sample's outline, upward");
    visit("outline/right", s.outline.right, "length", "right side of the sample's outline, upward");
  }

  // Attributes of the stage's group. They are finite unless their Meaning says otherwise. A frame of another code may have nan in
  // all attributes except those of is_always_told().
  template <class AnySnapshot, class Visit> void visit_attributes(AnySnapshot &s, Visit &&visit)
  {
    visit("walk", s.loading_variable, "-",
          "which attribute progress equals: axial_strain, shear_strain or time; path: that of its rows");
    visit("progress", s.progress, "strain or time", "loading variable: axial strain, shear strain, time or that of the path");
    visit("axial_strain", s.axial_strain, "-", "descent of the upper platen / initial height");
    visit("shear_strain", s.shear_strain, "-", "travel of the upper platen to the right / initial height");
    visit("time", s.time, "time", "time since the start of the loading");
    visit("step", s.step, "time", "length of the last step");
    visit("residual", s.residual, "-", "residual of the last step: natural map relative to the impulses");
    visit("mean_diameter", s.mean_diameter, "length", "mean diameter d");
    visit("stress_error", s.stress_error, "-",
          Meaning("estimated rms error of the last step's grain stress / its rms; nan: not estimated, inf: unknown", true, true));
    visit(
      "stress_change", s.stress_change, "-",
      Meaning("relative change of the grain stress in the last doubling of the sweeps; nan: not estimated, inf: no earlier value",
              true, true));
    visit(
      "error_over_residual", s.error_over_residual, "-",
      Meaning("error of grain stress / residual, measured once per run; nan: not measured, inf: the residual was 0", true, true));
    visit("window_time", s.window_time, "time",
          "duration of the window over which means are taken; 0: the window has not started");
    visit("lower_y", s.lower_y, "length", "height of the lower platen");
    visit("upper_y", s.upper_y, "length", "height of the upper platen");
    visit("left_x", s.left_x, "length", Meaning("x of the left wall; nan if there is none", true));
    visit("right_x", s.right_x, "length", Meaning("x of the right wall; nan if there is none", true));
    visit("cell_width", s.cell_width, "length", "width of the periodic cell; 0 if there is none");
    visit("cell_a1_x", s.cell_vectors(0, 0), "length", "cell periodic in both directions: x of its first vector; 0 without one");
    visit("cell_a1_y", s.cell_vectors(1, 0), "length", "y of the first vector");
    visit("cell_a2_x", s.cell_vectors(0, 1), "length", "x of the second vector");
    visit("cell_a2_y", s.cell_vectors(1, 1), "length", "y of the second vector");
    visit("area", s.area, "length^2", "area of the outline");
    visit("upper_platen_displacement_x", s.upper_platen_displacement.x(), "length",
          "displacement of the upper platen since the start of the loading, to the right");
    visit("upper_platen_displacement_y", s.upper_platen_displacement.y(), "length",
          "displacement of the upper platen since the start of the loading, upwards");
    visit("lower_platen_force_x", s.lower_platen_force.x(), "pressure length",
          "force of the lower platen on the sample in the last step, to the right");
    visit("lower_platen_force_y", s.lower_platen_force.y(), "pressure length",
          "force of the lower platen on the sample in the last step, upwards");
    visit("upper_platen_force_x", s.upper_platen_force.x(), "pressure length",
          "force of the upper platen on the sample in the last step, to the right");
    visit("upper_platen_force_y", s.upper_platen_force.y(), "pressure length",
          "force of the upper platen on the sample in the last step, upwards");
  }

  inline bool is_always_told(const std::string &name)
  {
    for (const char *known :
         {"progress", "axial_strain", "mean_diameter", "window_time", "lower_y", "upper_y", "cell_width", "area"})
      if (name == known)
        return true;
    return false;
  }
} // namespace diptych::discrete
