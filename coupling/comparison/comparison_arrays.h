// diptych: the only list of the arrays of a comparison
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "coupling/comparison/comparison.h"
#include "coupling/numbers/array_entry.h"
#include "discrete/snapshot_fields.h"

namespace diptych::coupling
{
  // Arrays on cells are NaN where a panel has no value. Tensors are positive in compression, row index = component of the force.
  // Rotations are anticlockwise.
  namespace arrays
  {
    // s = (s_xx + s_yy)/2 and t/s of the symmetric part; NaN in tension.
    std::vector<double> mean_stress(const std::vector<Eigen::Matrix2d> &stress);
    std::vector<double> stress_ratio(const std::vector<Eigen::Matrix2d> &stress);

    // Principal stresses s_1 >= s_2 of the symmetric part [pressure], and the direction of s_1 from the horizontal [rad].
    std::vector<double> major_stress(const std::vector<Eigen::Matrix2d> &stress);
    std::vector<double> minor_stress(const std::vector<Eigen::Matrix2d> &stress);
    std::vector<double> stress_direction(const std::vector<Eigen::Matrix2d> &stress);

    std::vector<std::vector<double>> rows_of(const ProfileCurve &curve); // value, low, high

    std::vector<double> sizes_over(const std::vector<Eigen::Vector2d> &vectors, double unit);
    std::vector<double> difference(const std::vector<double> &a, const std::vector<double> &b); // a - b if both are known
    std::vector<Eigen::Matrix2d> difference(const std::vector<Eigen::Matrix2d> &a, const std::vector<Eigen::Matrix2d> &b);

    // Moments of the couples of single grains (averaging/carriers.h), mean over the stage.
    std::vector<Eigen::Vector2d> couple_moments(const discrete::Snapshot &grains);

    // Stress of single grains: moment over the grain's share of the sample's area [pressure].
    std::vector<Eigen::Matrix2d> grain_stress(const discrete::Snapshot &grains);
  } // namespace arrays

  struct MotionUnits
  {
    double displacement = 1, velocity = 1; // [length], [length/time]
  };
  MotionUnits motion_units(const Increment &increment);

  template <class Visit> void list_cell_arrays(const CellFields &f, const MotionUnits &unit, Visit &&visit)
  {
    const GrainFields     &g = f.grains;
    const ContinuumFields &c = f.continuum;
    visit(ArrayEntry{"discrete_stress", "stress", "pressure", "grains: mean over the stage, with the dynamic part"}, g.stress);
    visit(ArrayEntry{"discrete_contact_stress", "contact stress", "pressure",
                     "grains: mean over the stage, without the dynamic part"},
          g.contact_stress);
    visit(ArrayEntry{"discrete_mean_stress", "mean stress s", "pressure", "grains: (s_1 + s_2)/2"},
          arrays::mean_stress(g.stress));
    visit(ArrayEntry{"discrete_stress_ratio", "stress ratio t/s", "-", "grains: (s_1 - s_2)/(s_1 + s_2)"},
          arrays::stress_ratio(g.stress));
    visit(
      ArrayEntry{"discrete_strain_increment", "strain increment", "-", "grains: affine fit over 2.5 d, positive in compression"},
      strain_increments(g.displacement_gradient));
    visit(ArrayEntry{"discrete_shear_strain_increment", "shear strain increment", "-", "grains: eps_1 - eps_2"},
          g.shear_strain_increment);
    visit(ArrayEntry{"discrete_displacement_increment", "displacement increment", "length", "grains: mean weighted by disc area"},
          g.displacement_increment);
    visit(ArrayEntry{"discrete_displacement_over_platen", "displacement over the platen's", "-",
                     "grains: magnitude of the displacement increment"},
          arrays::sizes_over(g.displacement_increment, unit.displacement));
    visit(ArrayEntry{"discrete_velocity", "velocity", "length/time", "grains: mean weighted by mass at the end of the stage"},
          g.velocity);
    visit(ArrayEntry{"discrete_speed_over_platen", "speed over the platen's", "-",
                     "grains: magnitude of the velocity at the end of the stage"},
          arrays::sizes_over(g.velocity, unit.velocity));
    visit(
      ArrayEntry{"discrete_rotation_increment", "rotation increment", "rad", "grains: mean weighted by disc area, anticlockwise"},
      g.rotation_increment);
    visit(
      ArrayEntry{"discrete_spin_increment", "spin increment of the medium", "rad", "grains: half the curl of the displacement"},
      g.spin_increment);
    visit(ArrayEntry{"discrete_relative_rotation", "rotation minus spin", "rad",
                     "grains: rotation of the grains minus spin of the medium, both over 2.5 d"},
          g.relative_rotation);
    visit(ArrayEntry{"discrete_couple_stress", "couple stress", "pressure length",
                     "grains: power-conjugate to the gradient of rotation"},
          g.couple_stress);
    visit(ArrayEntry{"discrete_couple_stress_size", "size of the couple stress", "pressure length",
                     "grains: magnitude of the couple stress"},
          arrays::sizes_over(g.couple_stress, 1));
    visit(ArrayEntry{"discrete_dissipation", "dissipation", "pressure", "grains: by friction, over the stage, per area"},
          g.dissipation);
    visit(ArrayEntry{"discrete_coordination_number", "coordination number", "-",
                     "grains: contacts per grain at the end of the stage"},
          g.coordination_number);
    visit(ArrayEntry{"discrete_fabric", "fabric", "-", "grains: mean of n (x) n over contact normals n at the end of the stage"},
          g.fabric);
    visit(ArrayEntry{"discrete_granular_temperature", "granular temperature", "length^2/time^2",
                     "grains: half the squared velocity about the affine motion"},
          g.granular_temperature);
    visit(ArrayEntry{"discrete_standard_error", "standard error of the mean pressure", "pressure",
                     "grains: for independent grains, a lower bound"},
          g.standard_error);
    visit(ArrayEntry{"grain_count", "grains", "-", "grains: sum of the shares of grains in the cell"}, g.grain_count);
    visit(ArrayEntry{"solid_fraction", "solid fraction", "-", "grains: area of discs / area of the cell"}, g.solid_fraction);
    visit(ArrayEntry{"continuum_stress", "stress", "pressure", "continuum: mean over the stage"}, c.stress);
    visit(ArrayEntry{"continuum_mean_stress", "mean stress s", "pressure", "continuum: (s_1 + s_2)/2"},
          arrays::mean_stress(c.stress));
    visit(ArrayEntry{"continuum_stress_ratio", "stress ratio t/s", "-", "continuum: (s_1 - s_2)/(s_1 + s_2)"},
          arrays::stress_ratio(c.stress));
    visit(ArrayEntry{"continuum_major_stress", "major principal stress", "pressure", "continuum: s_1"},
          arrays::major_stress(c.stress));
    visit(ArrayEntry{"continuum_minor_stress", "minor principal stress", "pressure", "continuum: s_2"},
          arrays::minor_stress(c.stress));
    visit(ArrayEntry{"continuum_stress_direction", "direction of the major stress", "rad", "continuum: from the horizontal"},
          arrays::stress_direction(c.stress));
    visit(ArrayEntry{"continuum_strain_increment", "strain increment", "-", "continuum: affine fit over 2.5 d as for the grains"},
          strain_increments(f.continuum_gradient));
    visit(ArrayEntry{"continuum_shear_strain_increment", "shear strain increment", "-", "continuum: eps_1 - eps_2"},
          f.continuum_shear);
    visit(ArrayEntry{"continuum_displacement_increment", "displacement increment", "length",
                     "continuum: mean over the corners of the cell"},
          c.displacement_increment);
    visit(
      ArrayEntry{"continuum_displacement_over_platen", "displacement over the platen's", "-", "continuum: size of the increment"},
      arrays::sizes_over(c.displacement_increment, unit.displacement));
    visit(ArrayEntry{"continuum_rotation_increment", "rotation increment", "rad", "continuum: Cosserat rotation, anticlockwise"},
          c.rotation_increment);
    visit(ArrayEntry{"continuum_spin_increment", "spin increment of the medium", "rad",
                     "continuum: half the curl of the displacement"},
          f.continuum_spin);
    visit(ArrayEntry{"continuum_relative_rotation", "rotation minus spin", "rad",
                     "continuum: Cosserat rotation minus spin, both over 2.5 d"},
          f.continuum_relative);
    visit(ArrayEntry{"continuum_couple_stress", "couple stress", "pressure length",
                     "continuum: same sign convention as for the grains"},
          c.couple_stress);
    visit(ArrayEntry{"continuum_couple_stress_size", "size of the couple stress", "pressure length",
                     "continuum: magnitude of the couple stress"},
          arrays::sizes_over(c.couple_stress, 1));
    visit(ArrayEntry{"continuum_dissipation", "dissipation", "pressure", "continuum: plastic work over the stage, per area"},
          c.dissipation);
    visit(ArrayEntry{"stress_difference", "difference of the stresses", "pressure", "continuum minus grains"},
          arrays::difference(c.stress, g.stress));
  }

  // Curves across the band, rows of value and ends of the 95 % interval; without rows if no panel has a band.
  template <class Visit> void list_profile_arrays(const BandProfile &p, Visit &&visit)
  {
    visit(ArrayEntry{"distance", "distance from the band", "mean diameters", "middles of the strips, along the band's normal"},
          p.distance);
    visit(ArrayEntry{"relative_rotation", "rotation minus spin", "rad",
                     "value, low, high; as the band's shear turns; nan in a classical continuum"},
          arrays::rows_of(p.relative_rotation));
    visit(ArrayEntry{"spin", "spin of the material", "rad", "value, low, high: half the curl of the displacement increment"},
          arrays::rows_of(p.spin));
    visit(ArrayEntry{"couple_stress", "couple stress", "pressure length",
                     "value, low, high: component along the band's normal; nan in a classical continuum"},
          arrays::rows_of(p.couple_stress));
    visit(ArrayEntry{"solid_fraction", "solid fraction", "-",
                     "value, low, high; continuum: that of the grains at the start times initial over present area"},
          arrays::rows_of(p.solid_fraction));
    visit(ArrayEntry{"velocity_fluctuation", "fluctuation of velocity", "-",
                     "value, low, high: root mean square about the affine motion / speed of the platen; nan in a continuum"},
          arrays::rows_of(p.velocity_fluctuation));
  }

  template <class Visit> void list_platen_arrays(const PlatenParts &parts, const double mean_diameter, Visit &&visit)
  {
    std::vector<double> place, ratio, slip;
    for (const PlatenPart &part : parts)
      {
        place.push_back(part.place);
        ratio.push_back(part.normal > 0 ? -part.shear / part.normal : NAN);
        slip.push_back(part.slip / mean_diameter);
      }
    visit(ArrayEntry{"place", "place along the platen", "half widths", "middles of the parts of a platen, from its middle"},
          place);
    visit(ArrayEntry{"stress_ratio", "shear / normal stress", "-",
                     "mean over the stages, to the left on the lower platen; the upper one is turned by half a turn; nan where "
                     "nothing presses"},
          ratio);
    visit(ArrayEntry{"slip", "slip", "mean diameters", "to the right relative to the platen, per unit progress"}, slip);
  }

  template <class Visit> void list_increment_arrays(const Increment &i, const discrete::Snapshot &to, Visit &&visit)
  {
    const MotionUnits unit = motion_units(i);
    visit(ArrayEntry{"discrete/position", "place", "length", "centres of the grains at the end of the increment"},
          i.discrete.field.position);
    visit(ArrayEntry{"discrete/radius", "radius", "length", "radius of the grains"}, to.radius);
    visit(
      ArrayEntry{"discrete/displacement_increment", "displacement increment", "length", "displacement increment of the grains"},
      i.discrete.field.increment);
    visit(ArrayEntry{"discrete/displacement_over_platen", "displacement over the platen's", "-",
                     "magnitude of the displacement increment of the grains"},
          arrays::sizes_over(i.discrete.field.increment, unit.displacement));
    visit(ArrayEntry{"discrete/shear_strain_increment", "shear strain increment", "-",
                     "eps_1 - eps_2 around each grain; nan if no other grain is near"},
          i.grain_shear);
    visit(ArrayEntry{"nodes/position", "place", "length", "positions of the continuum's nodes at the end of the increment"},
          i.continuum.field.position);
    visit(ArrayEntry{"nodes/displacement_increment", "displacement increment", "length",
                     "displacement increment of the continuum's nodes"},
          i.continuum.field.increment);
  }

  template <class Visit>
  void list_window_cell_arrays(const Increment &i, const std::vector<Eigen::Vector2d> &moved, Visit &&visit)
  {
    visit(ArrayEntry{"discrete_shear_strain_increment", "shear strain increment", "-", "grains: eps_1 - eps_2"},
          i.discrete.cell_shear);
    visit(ArrayEntry{"continuum_shear_strain_increment", "shear strain increment", "-", "continuum: eps_1 - eps_2"},
          i.continuum.cell_shear);
    visit(
      ArrayEntry{"continuum_displacement_over_platen", "displacement over the platen's", "-", "continuum: size of the increment"},
      arrays::sizes_over(moved, motion_units(i).displacement));
  }

  // Lists the grains' arrays of a stage: their state at its end, and their forces over it.
  template <class Visit>
  void list_grain_arrays(const Increment &i, const discrete::Snapshot &from, const discrete::Snapshot &to, Visit &&visit)
  {
    std::vector<double> rotation;
    for (std::size_t k = 0; k < to.rotation.size(); ++k)
      rotation.push_back(to.rotation[k] - from.rotation[k]);
    std::vector<Eigen::Vector2d>    point, force;
    std::vector<std::array<int, 2>> body;
    for (const discrete::ContactForce &contact : to.window_forces)
      {
        point.push_back(contact.point);
        force.push_back(contact.force);
        body.push_back({contact.i, contact.j});
      }
    const std::vector<Eigen::Matrix2d> stress = arrays::grain_stress(to);
    visit(ArrayEntry{"discrete/velocity", "velocity", "length/time", "velocity of the grains at the end of the stage"},
          to.velocity);
    visit(ArrayEntry{"discrete/speed_over_platen", "speed over the platen's", "-",
                     "magnitude of the grains' velocity at the end of the stage"},
          arrays::sizes_over(to.velocity, motion_units(i).velocity));
    visit(
      ArrayEntry{"discrete/rotation_increment", "rotation increment", "rad", "rotation increment of the grains, anticlockwise"},
      rotation);
    visit(ArrayEntry{"discrete/mean_internal_moment", "internal moment", "pressure length^2",
                     "internal moment of each grain, mean over the stage"},
          to.mean_internal_moment);
    visit(ArrayEntry{"discrete/couple_moment", "moment of couples", "pressure length^2",
                     "couple stress of each grain times area, mean over the stage"},
          arrays::couple_moments(to));
    visit(
      ArrayEntry{"discrete/stress", "stress", "pressure", "internal moment of each grain over its share of the sample's area"},
      stress);
    visit(ArrayEntry{"discrete/mean_stress", "mean stress s", "pressure", "single grains: (s_1 + s_2)/2"},
          arrays::mean_stress(stress));
    visit(ArrayEntry{"discrete/stress_ratio", "stress ratio t/s", "-", "single grains: (s_1 - s_2)/(s_1 + s_2)"},
          arrays::stress_ratio(stress));
    visit(ArrayEntry{"discrete/major_stress", "major principal stress", "pressure", "single grains: s_1"},
          arrays::major_stress(stress));
    visit(ArrayEntry{"discrete/minor_stress", "minor principal stress", "pressure", "single grains: s_2"},
          arrays::minor_stress(stress));
    visit(ArrayEntry{"discrete/stress_direction", "direction of the major stress", "rad",
                     "single grains: angle of s_1 from the horizontal"},
          arrays::stress_direction(stress));
    visit(ArrayEntry{"discrete/rattler", "rattlers", "-", "1 where the grain carries no contact force"},
          std::vector<int>(to.rattler.begin(), to.rattler.end()));
    visit(ArrayEntry{"window/point", "contact point", "length", "contact point of every pair that touched in the stage"}, point);
    visit(ArrayEntry{"window/force", "contact force", "pressure length", "contact force on the first body, mean over the stage"},
          force);
    visit(ArrayEntry{"window/body", "bodies", "-", discrete::contact_bodies}, body);
    visit(ArrayEntry{"outline/left", "left side", "length", "left side of the sample's outline, upward"}, to.outline.left);
    visit(ArrayEntry{"outline/right", "right side", "length", "right side of the sample's outline, upward"}, to.outline.right);
  }

  template <class Visit> void list_mesh_arrays(const QuadMesh &mesh, Visit &&visit)
  {
    visit(ArrayEntry{"node_position", "place", "length", "positions of the nodes"}, mesh.node);
    visit(ArrayEntry{"nodes", "nodes of a cell", "-", "corners of each cell anticlockwise, counted from 0"}, mesh.cell);
  }

  template <class Visit> void list_increment_attributes(const Increment &i, Visit &&visit)
  {
    const MotionUnits unit = motion_units(i);
    visit(NumberEntry{"from", "strain or time", "progress at the beginning of the increment"}, i.from);
    visit(NumberEntry{"to", "strain or time", "progress at the end of the increment"}, i.to);
    visit(NumberEntry{"displacement_unit", "length", "unit of displacements: the displacement of the upper platen"},
          unit.displacement);
    visit(NumberEntry{"velocity_unit", "length/time", "unit of velocities: the velocity of the upper platen"}, unit.velocity);
    visit(NumberEntry{"centre", "length", "centre of the sample, the origin of the offsets of bands"}, i.frame.centre);
  }

  template <class Visit>
  void list_file_attributes(const LoadingOptions     &loading,
                            const double              mean_diameter,
                            const discrete::Snapshot &start,
                            Visit                   &&visit)
  {
    const auto  &left   = start.outline.left;
    const double height = left.empty() ? NAN : left.back().y() - left.front().y();
    visit(NumberEntry{"mean_diameter", "length", "mean diameter d of the grains"}, mean_diameter);
    visit(NumberEntry{"pressure", "pressure", "lateral pressure P on the sample"}, loading.pressure);
    visit(NumberEntry{"height0", "length", "distance between the platens before the loading"}, start.upper_y - start.lower_y);
    visit(NumberEntry{"width0", "length", "area of the sample's outline over its height before the loading"},
          start.area / height);
    visit(NumberEntry{"walk", "-", "meaning of progress: axial_strain, shear_strain or time"},
          std::string(discrete::name_of(discrete::loading_variable_of(loading.mode))));
  }

  template <class Visit> void list_history_arrays(const HistoryTable &history, const double width, Visit &&visit)
  {
    visit(ArrayEntry{"progress", "progress", "strain or time", "progress of the loading"}, column(history, "progress"));
    visit(ArrayEntry{"stress_ratio_mean", "stress ratio t/s", "-", "running mean of the stress ratio"},
          running_mean(history, "stress_ratio", width));
    visit(ArrayEntry{"lower_fy_mean", "force of the lower platen", "pressure length",
                     "running mean of the vertical force of the lower platen"},
          running_mean(history, "lower_fy", width));
    visit(ArrayEntry{"upper_fy_mean", "force of the upper platen", "pressure length",
                     "running mean of the vertical force of the upper platen"},
          running_mean(history, "upper_fy", width));
    visit(ArrayEntry{"platen_difference", "difference of the platen forces", "-",
                     "|lower + upper| of the vertical platen forces / their mean size"},
          platen_differences(history));
  }
} // namespace diptych::coupling
