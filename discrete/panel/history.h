// diptych: history of a loading, one row per step
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <type_traits>
#include <vector>

#include "discrete/meaning.h"
#include "discrete/stepping/time_stepping.h"
#include "discrete/loading_variable.h"

namespace diptych::discrete
{
  // One row of discrete.csv. Stress and strain are positive in compression, and forces act on the sample. Sums start with the
  // loading.
  struct HistoryRow
  {
    int             step = 0;                                     // steps so far; the halves of a halved step count
    double          time = 0, axial_strain = 0, shear_strain = 0; // descent and travel of the upper platen / initial height
    double          stress_ratio = 0, volumetric_strain = 0, solid_fraction = 0;
    double          width    = 0;                          // area of the outline / height
    double          side_sxx = 0, platen_sxx = 0;          // parts of sxx that the forces at sides and platens cause
    Eigen::Matrix2d stress      = Eigen::Matrix2d::Zero(); // sum of internal moments / sample area
    Eigen::Matrix2d core_stress = Eigen::Matrix2d::Zero(); // the same in the middle half of the height
    Eigen::Vector2d lower_force = Eigen::Vector2d::Zero(), upper_force = Eigen::Vector2d::Zero();
    Eigen::Vector2d left_force = Eigen::Vector2d::Zero(), right_force = Eigen::Vector2d::Zero(); // of side walls
    int             contacts       = 0;                                                          // with force
    long            sweeps         = 0;                                                          // since the previous row
    double          residual       = 0;
    double          kinetic_energy = 0, kinetic_energy_ratio = 0; // of grains, free walls and cell; ratio to M |V|^2 / 4
    double          friction_dissipation = 0, impact_dissipation = 0, external_work = 0, correction_work = 0;
    double          energy_residual   = 0; // (kinetic - initial - work + dissipations) / largest of the sums so far
    double          inertial_number   = 0; // with the present mean stress s instead of P
    double          max_penetration   = 0; // at mid-step, largest since the previous row [mean diameters]
    int             rattlers          = 0; // grains without a force-carrying contact
    double          spin_term_share   = 0; // sum (1/2) J omega^2 / area / mean stress
    double          momentum_residual = 0; // largest since the previous row, relative to the sums of contact impulses and momenta
    double          unbalanced_force  = 0; // mean over grains of |m dv/h| / mean normal contact force
    double          platen_sliding    = 0; // share of the force-carrying platen contacts that are at their Coulomb bound
    double          rolling_dissipation = 0;
    double          skew_moment         = 0; // norm of the grains' skew moments / norm of the symmetric ones
    double          progress            = 0; // of the loading variable: axial_strain, shear_strain, time or that of a path
    double          coordination        = 0; // contacts per grain that carry force, without rattlers
    double          fabric_anisotropy = 0, fabric_angle = 0; // of the contacts that carry force
    // A lattice only; 0 without one. Strains (exx, eyy, exy) and the mean stress that drives the cell (sxx, syy, sxy).
    Eigen::Vector3d strain = Eigen::Vector3d::Zero(), drive_stress = Eigen::Vector3d::Zero();
    LoadingVariable loading_variable = LoadingVariable::axial_strain;
  };

  // Calls visit(column, value, unit, meaning) for every number of a row in the order of discrete.csv.
  template <class Row, class Visit, std::enable_if_t<std::is_same_v<std::remove_const_t<Row>, HistoryRow>, int> = 0>
  void visit_columns(Row &r, Visit &&visit)
  {
    visit("step", r.step, "-", "steps so far; the halves of a halved step count");
    visit("time", r.time, "time", "time since the start of the loading");
    visit("axial_strain", r.axial_strain, "-", "descent of the upper platen / initial height");
    visit("stress_ratio", r.stress_ratio, "-", Meaning("t/s of the mean stress; nan without stress", true));
    visit("volumetric_strain", r.volumetric_strain, "-", "1 - V/V0 of the outline, dilation negative");
    visit("sxx", r.stress(0, 0), "pressure", "mean stress: sum of internal moments / area of the outline, xx component");
    visit("sxy", r.stress(0, 1), "pressure", "mean stress, xy component (row: of the force)");
    visit("syx", r.stress(1, 0), "pressure", "mean stress, yx component");
    visit("syy", r.stress(1, 1), "pressure", "mean stress, yy component");
    visit("lower_fx", r.lower_force.x(), "pressure length", "force of the lower platen on the sample, to the right");
    visit("lower_fy", r.lower_force.y(), "pressure length", "force of the lower platen on the sample, upwards");
    visit("upper_fx", r.upper_force.x(), "pressure length", "force of the upper platen on the sample, to the right");
    visit("upper_fy", r.upper_force.y(), "pressure length", "force of the upper platen on the sample, upwards");
    visit("contacts", r.contacts, "-", "contacts that carry force");
    visit("sweeps", r.sweeps, "-", "sweeps of the contact solver since the previous row");
    visit("residual", r.residual, "-", "residual of the last step: natural map relative to the impulses");
    visit("kinetic_energy", r.kinetic_energy, "pressure length^2", "kinetic energy of grains, free walls and cell");
    visit("kinetic_energy_ratio", r.kinetic_energy_ratio, "-",
          "kinetic energy / (M |V|^2 / 4), M the mass of the grains, V the speed of the upper platen");
    visit("friction_dissipation", r.friction_dissipation, "pressure length^2",
          "friction dissipation since the start of the loading");
    visit("impact_dissipation", r.impact_dissipation, "pressure length^2",
          "dissipation normal to the contacts since the start of the loading");
    visit("external_work", r.external_work, "pressure length^2",
          "work of walls, lateral action and gravity since the start of the loading");
    visit("correction_work", r.correction_work, "pressure length^2",
          "work of velocity corrections of penetrations since the start of the loading");
    visit("energy_residual", r.energy_residual, "-", "(kinetic - initial - work + dissipations) / largest of the sums so far");
    visit("inertial_number", r.inertial_number, "-", "inertial number with the present mean stress instead of the pressure");
    visit("max_penetration", r.max_penetration, "mean diameters", "largest penetration at mid-step since the previous row");
    visit("rattlers", r.rattlers, "-", "number of grains without a contact that carries force");
    visit("spin_term_share", r.spin_term_share, "-", "sum of (1/2) J omega^2 (J: moment of inertia) / area / mean stress");
    visit("momentum_residual", r.momentum_residual, "-",
          "largest error of the momentum balance since the previous row, relative to contact impulses and momenta");
    visit("unbalanced_force", r.unbalanced_force, "-", "mean over grains of |m dv/h| / mean normal contact force");
    visit("shear_strain", r.shear_strain, "-", "travel of the upper platen to the right / initial height");
    visit("solid_fraction", r.solid_fraction, "-", "area of the grains / area of the outline");
    visit("left_fx", r.left_force.x(), "pressure length",
          "force of the left wall on the sample, to the right; 0 if there is none");
    visit("left_fy", r.left_force.y(), "pressure length", "force of the left wall on the sample, upwards");
    visit("right_fx", r.right_force.x(), "pressure length",
          "force of the right wall on the sample, to the right; 0 if there is none");
    visit("right_fy", r.right_force.y(), "pressure length", "force of the right wall on the sample, upwards");
    visit("platen_sliding", r.platen_sliding, "-", "share of the force-carrying platen contacts at their Coulomb bound");
    visit("skew_moment", r.skew_moment, "-", "norm of the grains' skew moments / norm of the symmetric ones");
    visit("progress", r.progress, "strain or time", "loading variable: axial strain, shear strain, time or that of the path");
    visit("rolling_dissipation", r.rolling_dissipation, "pressure length^2",
          "dissipation by rolling resistance since the start of the loading");
    visit("walk", r.loading_variable, "-", "name of the loading variable: axial_strain, shear_strain, time or path");
    visit("coordination", r.coordination, "-", "contacts with force per grain; walls count, grains without force do not");
    visit("fabric_anisotropy", r.fabric_anisotropy, "-",
          "2 (F1 - F2), principal values of the mean of n n^T over the contacts between grains with force, n: normal");
    visit("fabric_angle", r.fabric_angle, "degrees", "direction of F1 from the horizontal, in (-90, 90]");
    visit("exx", r.strain[0], "-", "cell: horizontal logarithmic strain; 0 for other samples");
    visit("eyy", r.strain[1], "-", "cell: vertical logarithmic strain; 0 for other samples");
    visit("exy", r.strain[2], "-", "cell: shear strain, component of the tensor; 0 for other samples");
    visit("drive_sxx", r.drive_stress[0], "pressure",
          "cell: stress that drives it, i.e. mean contact stress + inertia of the cell, xx component; 0 for other samples");
    visit("drive_syy", r.drive_stress[1], "pressure", "cell: stress that drives it, yy component; 0 for other samples");
    visit("drive_sxy", r.drive_stress[2], "pressure", "cell: stress that drives it, xy component; 0 for other samples");
    visit("core_sxx", r.core_stress(0, 0), "pressure", "mean stress in the middle half of the height, xx component");
    visit("core_sxy", r.core_stress(0, 1), "pressure", "mean stress there, xy component");
    visit("core_syy", r.core_stress(1, 1), "pressure", "mean stress there, yy component");
    visit("width", r.width, "length", "area of the outline / height");
    visit("side_sxx", r.side_sxx, "pressure",
          "part of the mean sxx that the forces at the sides cause: their moment about a vertical line / area of the outline; 0 "
          "without them");
    visit("platen_sxx", r.platen_sxx, "pressure",
          "part that the platens cause; accelerations and spin cause what is left; meaningless between periodic sides");
  }

  struct Reference
  {
    std::vector<Eigen::Vector2d> position;                         // of the grains
    Eigen::Vector2d              platen = Eigen::Vector2d::Zero(); // point of the upper platen
    double                       height = 0, area = 0, grain_area = 0, kinetic_energy = 0;
    double platen_kinetic_energy = 0; // M |V|^2 / 4, M the mass of the grains, V the prescribed velocity of the upper platen
    double strain_rate = 0, mean_density = 0;
  };
  Reference make_reference(const State &state, double mean_diameter, double strain_rate);

  // Descent and travel of the upper platen / initial height. Of a lattice: 1 - exp(-eyy) and 2 exy.
  struct Strains
  {
    double axial, shear;
  };
  Strains strains_of(const State &state, const Reference &reference);

  // Adds a step to the sums of the row. Call it for every step.
  void add_step(const StepResult &result, const StepSetting &setting, HistoryRow &row);

  // Fills in the present state of the sample. Call it for every output.
  void describe_state(const State       &state,
                      const StepResult  &result,
                      const Reference   &reference,
                      const StepSetting &setting,
                      HistoryRow        &row);

  // 1 for each free grain without a contact that carries force.
  std::vector<std::uint8_t> rattlers(const StepResult &result, const Grains &grains);
} // namespace diptych::discrete
