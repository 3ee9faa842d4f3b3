// diptych: the ledger of a loading, one row a step
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "discrete/time_stepping.h"

namespace diptych::discrete
{
  // One row of discrete.csv. Stress and strain positive in compression; forces act on the sample. Sums count from the start of
  // the loading.
  struct HistoryRow
  {
    int             step = 0;                                     // taken so far, halves of halved ones counted
    double          time = 0, axial_strain = 0, shear_strain = 0; // descent and travel of the upper platen / initial height
    double          stress_ratio = 0, volumetric_strain = 0, solid_fraction = 0;
    Eigen::Matrix2d stress      = Eigen::Matrix2d::Zero(); // sum of internal moments / sample area
    Eigen::Vector2d lower_force = Eigen::Vector2d::Zero(), upper_force = Eigen::Vector2d::Zero();
    Eigen::Vector2d left_force = Eigen::Vector2d::Zero(), right_force = Eigen::Vector2d::Zero(); // of side walls
    int             contacts       = 0;                                                          // that carry force
    long            sweeps         = 0;                                                          // since the row before
    double          residual       = 0;
    double          kinetic_energy = 0, kinetic_energy_ratio = 0; // of grains, free walls and cell; ratio to M |V|^2 / 4
    double          friction_dissipation = 0, impact_dissipation = 0, external_work = 0, correction_work = 0;
    double          energy_residual   = 0; // (kinetic - initial - work + dissipations) / largest of the sums so far
    double          inertial_number   = 0; // with the present mean stress s in the place of P
    double          max_penetration   = 0; // at mid-step, largest since the row before [mean diameters]
    int             rattlers          = 0; // grains without a force-carrying contact
    double          spin_term_share   = 0; // sum (1/2) omega^2 I / area / mean stress
    double          momentum_residual = 0; // largest since the row before, relative to the sums of contact impulses and momenta
    double          unbalanced_force  = 0; // mean over grains of |m dv/h| / mean normal contact force
    double          platen_sliding    = 0; // share of the force-carrying platen contacts that are at their Coulomb bound
    double          skew_moment       = 0; // norm of the grains' skew moments / norm of the symmetric ones
  };

  // Every number of a row under its column's name, in the order of the file: visit(name, value).
  template <class Row, class Visit> void visit_columns(Row &r, Visit &&visit)
  {
    visit("step", r.step), visit("time", r.time), visit("axial_strain", r.axial_strain), visit("stress_ratio", r.stress_ratio);
    visit("volumetric_strain", r.volumetric_strain), visit("sxx", r.stress(0, 0)), visit("sxy", r.stress(0, 1));
    visit("syx", r.stress(1, 0)), visit("syy", r.stress(1, 1)), visit("lower_fx", r.lower_force.x());
    visit("lower_fy", r.lower_force.y()), visit("upper_fx", r.upper_force.x()), visit("upper_fy", r.upper_force.y());
    visit("contacts", r.contacts), visit("sweeps", r.sweeps), visit("residual", r.residual);
    visit("kinetic_energy", r.kinetic_energy), visit("kinetic_energy_ratio", r.kinetic_energy_ratio);
    visit("friction_dissipation", r.friction_dissipation), visit("impact_dissipation", r.impact_dissipation);
    visit("external_work", r.external_work), visit("correction_work", r.correction_work);
    visit("energy_residual", r.energy_residual), visit("inertial_number", r.inertial_number);
    visit("max_penetration", r.max_penetration), visit("rattlers", r.rattlers), visit("spin_term_share", r.spin_term_share);
    visit("momentum_residual", r.momentum_residual), visit("unbalanced_force", r.unbalanced_force);
    visit("shear_strain", r.shear_strain), visit("solid_fraction", r.solid_fraction), visit("left_fx", r.left_force.x());
    visit("left_fy", r.left_force.y()), visit("right_fx", r.right_force.x()), visit("right_fy", r.right_force.y());
    visit("platen_sliding", r.platen_sliding), visit("skew_moment", r.skew_moment);
  }

  // What stays constant while the sample is loaded.
  struct Reference
  {
    std::vector<Eigen::Vector2d> position;                         // of the grains
    Eigen::Vector2d              platen = Eigen::Vector2d::Zero(); // point of the upper one
    double                       height = 0, area = 0, grain_area = 0, kinetic_energy = 0;
    double                       platen_kinetic_energy = 0; // M |V|^2 / 4 with V the upper platen's prescribed velocity
    double                       strain_rate = 0, mean_density = 0;
  };
  Reference make_reference(const State &state, double mean_diameter, double strain_rate);

  // Adds a step to the sums of the row: to be called every step.
  void add_step(const StepResult &result, const StepSetting &setting, HistoryRow &row);

  // Fills in where the sample stands: at every output.
  void describe_state(const State       &state,
                      const StepResult  &result,
                      const Reference   &reference,
                      const StepSetting &setting,
                      HistoryRow        &row);

  // 1 where a grain that is not fixed has no contact that carries force.
  std::vector<std::uint8_t> rattlers(const StepResult &result, const Grains &grains);

  // discrete.csv: columns named in the first line. Throws std::runtime_error naming the file.
  void write_history(const std::string &csv_path, const std::vector<HistoryRow> &rows);
} // namespace diptych::discrete
