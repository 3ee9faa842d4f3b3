// diptych: the one list of what a snapshot of the grains holds, as files and readers of files take it
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "discrete/meaning.h"
#include "discrete/snapshot.h"

namespace diptych::discrete
{
  // Each calls visit(name, member, unit, meaning). Names are those of the datasets below a stage's group of discrete.h5. Vectors
  // are stored with three components (z = 0), tensors with nine, row by row; row = component of the force. Stress-like quantities
  // are positive in compression, angles anticlockwise; all is per unit thickness.

  template <class AnySnapshot, class Visit> void visit_grain_fields(AnySnapshot &s, Visit &&visit)
  {
    visit("grains/position", s.position, "length", "centre");
    visit("grains/displacement", s.displacement, "length", "of the centre since the start of the loading");
    visit("grains/velocity", s.velocity, "length/time", "of the centre");
    visit("grains/rotation", s.rotation, "rad", "since the start of the loading");
    visit("grains/spin", s.spin, "rad/time", "angular velocity");
    visit("grains/radius", s.radius, "length", "radius");
    visit("grains/mass", s.mass, "mass", "mass");
    visit("grains/internal_moment", s.internal_moment, "pressure length^2",
          "internal moment in the last step, spin term included");
    visit("grains/mean_internal_moment", s.mean_internal_moment, "pressure length^2",
          "internal moment of the mean contact forces of the stage, mean spin term included");
    visit("grains/mean_spin_term", s.mean_spin_term, "pressure length^2",
          "mean over the stage of (1/2) omega^2 I, which enters the internal moment as -1 times it");
    visit("grains/rattler", s.rattler, "-", "1 where the grain carries no contact force");
    visit("grains/fixed", s.fixed, "-",
          "1 where nothing moves the grain, 2 and 3 where it is part of the lower and upper platen");
    visit("grains/applied_force", s.applied_force, "pressure length", "lateral action and gravity in the last step");
  }

  // Of one entry of a list of contacts; the pair of bodies stands beside it.
  template <class AnyContact, class Visit> void visit_contact_fields(AnyContact &c, Visit &&visit)
  {
    visit("point", c.point, "length", "contact point");
    visit("normal", c.normal, "-", "unit vector from the second body to the first");
    visit("force", c.force, "pressure length", "on the first body");
    visit("image_shift", c.shift, "length",
          "x of the image of the second body that touches minus x of that body; not 0 only across the edge of a periodic cell");
  }
  inline constexpr char contact_bodies[] = "two numbers a contact: grains count from 0, walls on from the number of grains";

  template <class AnySnapshot, class Visit> void visit_contact_lists(AnySnapshot &s, Visit &&visit)
  {
    visit("contacts", s.contacts, "", "candidate contacts of the last step; open ones carry no force");
    visit("window", s.window_forces, "", "every pair that touched since the stage before: mean force (sum of impulses / time)");
  }

  // Beside the lists, one entry a contact.
  template <class AnySnapshot, class Visit> void visit_contact_values(AnySnapshot &s, Visit &&visit)
  {
    visit("contacts/gap", s.gap, "length", "distance of the surfaces; negative: penetration");
    visit("contacts/status", s.status, "-", "0 open, 1 sticking, 2 slipping, 3 not told (imported)");
    visit("window/dissipation", s.window_dissipation, "pressure length^2", "by friction, summed over the steps of the stage");
    visit("window/impact_dissipation", s.window_impact_dissipation, "pressure length^2",
          "along the normal, summed over the steps of the stage");
  }
  inline constexpr char contact_impulses[] = "normal and tangential impulse of the last step on the first body";

  template <class AnySnapshot, class Visit> void visit_outline(AnySnapshot &s, Visit &&visit)
  {
    visit("outline/left", s.outline.left, "length", "left side of the sample's outline, upward");
    visit("outline/right", s.outline.right, "length", "right side of the sample's outline, upward");
  }

  // Attributes of the stage's group. They are finite unless their Meaning says otherwise; of a frame of another code those
  // beside is_always_told() may be nan, too: it did not tell them.
  template <class AnySnapshot, class Visit> void visit_attributes(AnySnapshot &s, Visit &&visit)
  {
    visit("walk", s.walk, "-", "which attribute progress equals: axial_strain, shear_strain or time");
    visit("progress", s.progress, "as walk says", "what the loading has walked along its path");
    visit("axial_strain", s.axial_strain, "-", "descent of the upper platen / initial height");
    visit("shear_strain", s.shear_strain, "-", "travel of the upper platen to the right / initial height");
    visit("time", s.time, "time", "since the start of the loading");
    visit("step", s.step, "time", "length of the last step");
    visit("residual", s.residual, "-", "natural map relative to the impulses, of the last step");
    visit("mean_diameter", s.mean_diameter, "length", "mean diameter d");
    visit("stress_error", s.stress_error, "-",
          Meaning("estimated rms error of the last step's grain stress over its rms; nan: not estimated, inf: not known", true,
                  true));
    visit("stress_change", s.stress_change, "-",
          Meaning("change of the same in the last doubling of the sweeps; nan: not estimated, inf: from nothing", true, true));
    visit(
      "error_over_residual", s.error_over_residual, "-",
      Meaning("error of grain stress over residual, measured once in the run; nan: not, inf: of a residual of 0", true, true));
    visit("window_time", s.window_time, "time", "length of the stage over which means are taken; 0: no stage yet");
    visit("lower_y", s.lower_y, "length", "height of the lower platen");
    visit("upper_y", s.upper_y, "length", "height of the upper platen");
    visit("left_x", s.left_x, "length", Meaning("place of the left wall; nan where there is none", true));
    visit("right_x", s.right_x, "length", Meaning("place of the right wall; nan where there is none", true));
    visit("cell_width", s.cell_width, "length", "width of the periodic cell; 0 where there is none");
    visit("area", s.area, "length^2", "of the outline");
    visit("upper_platen_displacement_x", s.upper_platen_displacement.x(), "length", "since the start of the loading");
    visit("upper_platen_displacement_y", s.upper_platen_displacement.y(), "length", "since the start of the loading");
    visit("lower_platen_force_x", s.lower_platen_force.x(), "pressure length", "of the lower platen on the sample, last step");
    visit("lower_platen_force_y", s.lower_platen_force.y(), "pressure length", "of the lower platen on the sample, last step");
    visit("upper_platen_force_x", s.upper_platen_force.x(), "pressure length", "of the upper platen on the sample, last step");
    visit("upper_platen_force_y", s.upper_platen_force.y(), "pressure length", "of the upper platen on the sample, last step");
  }

  inline bool is_always_told(const std::string &name)
  {
    for (const char *told :
         {"progress", "axial_strain", "mean_diameter", "window_time", "lower_y", "upper_y", "cell_width", "area"})
      if (name == told)
        return true;
    return false;
  }
} // namespace diptych::discrete
