// diptych: the history of the continuum panel, one row per load step
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <type_traits>

#include <Eigen/Core>

#include "continuum/loading.h"

namespace diptych::continuum
{
  // One accepted load step. Counters and seconds are cumulative. Stress is positive in compression; forces act on the sample.
  struct HistoryRow
  {
    int             step               = 0;
    double          axial_strain       = 0;                       // descent of the upper platen / initial height
    double          stress_ratio       = 0;                       // t/s of the mean stress
    double          width              = 0;                       // area / height [length]
    double          volumetric_strain  = 0;                       // 1 - V/V0, dilation negative
    Eigen::Matrix3d mean_stress        = Eigen::Matrix3d::Zero(); // [pressure]
    Eigen::Matrix3d core_stress        = Eigen::Matrix3d::Zero(); // symmetric mean over the middle half of the height
    Eigen::Vector2d lower_platen_force = Eigen::Vector2d::Zero(); // [pressure * length]
    Eigen::Vector2d upper_platen_force = Eigen::Vector2d::Zero();
    double          platen_sxx         = 0; // part of the mean sxx that the platens cause [pressure]
    int             n_cells = 0, n_unknowns = 0;
    int             newton_iterations = 0, linear_iterations = 0, factorisations = 0, cut_backs = 0;
    double          plastic_share                 = 0; // share of the area that yields in this step
    double          unreliable_share              = 0; // share of the area where the law calls its answer unreliable
    double          share_zz_not_intermediate     = 0; // share of the area
    double          unstable_share                = 0; // share of the area that weakened while its plastic flow contracted
    double          viscous_share                 = 0; // overstress / shear strength, mean over the yielding area
    double          max_equivalent_plastic_strain = 0;
    double          dissipation                   = 0; // plastic work since the start [pressure * length^2]
    double          friction_work                 = 0; // dissipated along the walls since the start [pressure * length^2]
    double          least_acoustic_determinant    = 1; // relative to the elastic one
    double          localisation_angle            = 0; // of the line with the least determinant [degrees from the horizontal]
    double          point_cpu_s = 0, assembly_cpu_s = 0, solve_cpu_s = 0, geometry_cpu_s = 0; // on the first process
    double          time = 0, shear_strain = 0; // since the start; travel of the upper platen to the right / initial height
    double          progress         = 0;       // loading variable: axial_strain, shear_strain or time
    LoadingVariable loading_variable = LoadingVariable::axial_strain;
  };

  // The meaning of a column that may hold NaN. A plain text means that all numbers are finite.
  struct ColumnMeaning
  {
    operator const char *() const { return text; }

    const char *text;
    bool        may_be_nan;
  };

  // Every entry of a row in the order of continuum.csv: visit(name of the column, value, unit, meaning). Per unit thickness.
  template <class Row, class Visit, std::enable_if_t<std::is_same_v<std::remove_const_t<Row>, HistoryRow>, int> = 0>
  void visit_columns(Row &r, Visit &&visit)
  {
    visit("step", r.step, "-", "accepted load steps so far");
    visit("axial_strain", r.axial_strain, "-", "descent of the upper platen / initial height");
    visit("stress_ratio", r.stress_ratio, "-",
          ColumnMeaning{"t/s of the mean stress; nan if the sample carries no stress", true});
    visit("volumetric_strain", r.volumetric_strain, "-",
          "1 - V/V0, dilation negative; geometry = small_strain: trace of the mean strain");
    visit("sxx", r.mean_stress(0, 0), "pressure", "mean stress over the area, xx component");
    visit("sxy", r.mean_stress(0, 1), "pressure", "mean stress, xy component (x component of the force on a face with normal y)");
    visit("syy", r.mean_stress(1, 1), "pressure", "mean stress, yy component");
    visit("szz", r.mean_stress(2, 2), "pressure", "mean stress out of the plane");
    visit("lower_fx", r.lower_platen_force.x(), "pressure length", "force of the lower platen on the sample, to the right");
    visit("lower_fy", r.lower_platen_force.y(), "pressure length", "force of the lower platen on the sample, upwards");
    visit("upper_fx", r.upper_platen_force.x(), "pressure length", "force of the upper platen on the sample, to the right");
    visit("upper_fy", r.upper_platen_force.y(), "pressure length", "force of the upper platen on the sample, upwards");
    visit("newton_iterations", r.newton_iterations, "-", "Newton iterations so far");
    visit("linear_iterations", r.linear_iterations, "-", "GMRES iterations so far");
    visit("factorisations", r.factorisations, "-", "matrix factorisations so far");
    visit("cut_backs", r.cut_backs, "-", "halved load steps so far");
    visit("plastic_share", r.plastic_share, "-", "share of the area that yields in this step");
    visit("share_zz_not_intermediate", r.share_zz_not_intermediate, "-",
          "share of the area where the out-of-plane stress is not the intermediate principal stress");
    visit("max_equivalent_plastic_strain", r.max_equivalent_plastic_strain, "-", "largest value of the hardening variable");
    visit("assembly_cpu_s", r.assembly_cpu_s, "s", "CPU time for tangents on the first process so far");
    visit("solve_cpu_s", r.solve_cpu_s, "s", "CPU time for linear solves on the first process so far");
    visit("syx", r.mean_stress(1, 0), "pressure", "mean stress, yx component");
    visit("n_cells", r.n_cells, "-", "number of elements");
    visit("n_unknowns", r.n_unknowns, "-", "number of unknowns");
    visit("unreliable_share", r.unreliable_share, "-",
          "share of the area where softening is so fast that the law's answer may not be unique");
    visit("viscous_share", r.viscous_share, "-", "overstress / shear strength, mean over the yielding area");
    visit("dissipation", r.dissipation, "pressure length^2", "plastic work since the start");
    visit("least_acoustic_determinant", r.least_acoustic_determinant, "-",
          "least determinant det(n C n) of the acoustic tensor, relative to the elastic one");
    visit("localisation_angle", r.localisation_angle, "degrees",
          "angle from the horizontal of the band that could form where the determinant is least");
    visit("point_cpu_s", r.point_cpu_s, "s", "CPU time for the law on the first process so far");
    visit("geometry_cpu_s", r.geometry_cpu_s, "s",
          "CPU time for updating the geometry after accepted steps, on the first process so far");
    visit("time", r.time, "time", "since the start of the loading");
    visit("shear_strain", r.shear_strain, "-", "travel of the upper platen to the right / initial height");
    visit("progress", r.progress, "strain or time", "loading variable: axial strain, shear strain or time");
    visit("unstable_share", r.unstable_share, "-",
          "share of the area where the second-order work of the step is negative and plastic flow contracts");
    visit("friction_work", r.friction_work, "pressure length^2", "work of friction along platens and rigid side walls");
    visit("core_sxx", r.core_stress(0, 0), "pressure", "mean stress in the middle half of the height, xx component");
    visit("core_sxy", r.core_stress(0, 1), "pressure", "mean stress there, xy component");
    visit("core_syy", r.core_stress(1, 1), "pressure", "mean stress there, yy component");
    visit("width", r.width, "length", "area / height");
    visit(
      "platen_sxx", r.platen_sxx, "pressure",
      "part of the mean sxx that the platens cause: moment of their forces about a vertical line / area; sides cause the rest");
    visit("walk", r.loading_variable, "-", "column that progress equals: axial_strain, shear_strain or time");
  }
} // namespace diptych::continuum
