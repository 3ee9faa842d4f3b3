// diptych: the discrete panel, a grain sample loaded through a list of stages
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "discrete/sample_preparation.h"
#include "discrete/snapshot.h"

namespace diptych::discrete
{
  // Everything of the scene's section `discrete`.
  struct Options
  {
    StepOptions       time;
    ContactLawOptions law;
    SolverOptions     solver;
    LateralOptions    lateral;
  };

  template <class Visitor> void visit_parameters(Options &o, Visitor &&visitor)
  {
    visit_parameters(o.time, visitor);
    visit_parameters(o.law, visitor);
    visit_parameters(o.solver, visitor);
    visit_parameters(o.lateral, visitor);
  }

  struct Loading
  {
    double              pressure                 = 1;    // P of the containing action
    double              inertial_number          = 3e-5; // I = rate d sqrt(rho/P), rate = platen descent speed / height
    double              horizontal_over_vertical = 1;    // travel of the upper platen to the right per descent; 1: 45 degrees
    std::vector<double> stages;              // axial strains at which a snapshot is made, ascending; the last is the end
    bool                affine_start = true; // grains start with the velocities of the affine field between the platens
  };

  // One row of discrete.csv, one step. Stress and strain positive in compression; forces act on the sample.
  struct HistoryRow
  {
    int             step = 0;
    double          time = 0, axial_strain = 0, stress_ratio = 0, volumetric_strain = 0;
    Eigen::Matrix2d stress      = Eigen::Matrix2d::Zero(); // sum of internal moments / outline area
    Eigen::Vector2d lower_force = Eigen::Vector2d::Zero(), upper_force = Eigen::Vector2d::Zero();
    int             contacts       = 0; // that carry force
    long            sweeps         = 0;
    double          residual       = 0;
    double          kinetic_energy = 0, kinetic_energy_ratio = 0; // ratio to M |V|^2 / 4
    double          friction_dissipation = 0, impact_dissipation = 0, external_work = 0, correction_work = 0; // sums so far
    double          energy_residual   = 0; // (kinetic - initial - work + dissipations) / external work so far
    double          inertial_number   = 0; // with the present mean stress s in the place of P
    double          max_penetration   = 0; // at mid-step [mean diameters]
    int             rattlers          = 0;
    double          spin_term_share   = 0; // sum (1/2) omega^2 I / area / mean stress
    double          momentum_residual = 0; // relative to the sum of contact impulses
    double          unbalanced_force  = 0; // mean over grains of |m dv/h| / mean normal contact force
  };

  struct Callbacks
  {
    std::function<bool()>                            stop_requested = [] { return false; };
    std::function<void(const std::string &, double)> on_progress    = [](const std::string &, double) {};
    std::function<void(const Snapshot &)>            on_stage       = [](const Snapshot &) {};
    std::function<void(const HistoryRow &)>          on_step        = [](const HistoryRow &) {};
  };

  enum class Status
  {
    finished,
    stopped_by_user,
    not_converged
  };

  struct [[nodiscard]] Report
  {
    Status            status       = Status::finished;
    double            axial_strain = 0; // reached
    std::string       message;          // empty when finished
    PreparationReport preparation;
    double            step  = 0;                          // used, after fitting whole steps into the stages
    long              steps = 0, sweeps = 0, updates = 0; // of the loading; one update = one contact in one sweep
    double            preparation_cpu_s = 0, loading_cpu_s = 0, solver_cpu_s = 0;
    double            initial_height = 0, platen_speed = 0; // vertical part
  };

  // Prepares the sample and loads it through all stages. Snapshots are made of the prepared sample (stage 0) and at every
  // stage. Throws std::invalid_argument on options that contradict each other. Stops at the first step that does not
  // converge, with what was reached kept.
  Report run(const SampleOptions &sample, const Loading &loading, const Options &options, const Callbacks &callbacks);
} // namespace diptych::discrete
