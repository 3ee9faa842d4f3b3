// diptych: energy and momentum of one step
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "discrete/contacts/contact_detection.h"
#include "discrete/contacts/contact_problem.h"

namespace diptych::discrete
{
  // Work of one step. kinetic_change = external_work - friction_dissipation - rolling_dissipation - impact_dissipation to
  // round-off. Momentum is balanced over the step, so sum r.(u + u')/2 is the work of the impulses. Free walls, a free width
  // and a lattice are bodies with kinetic energy like grains. Prescribed walls, fixed grains and the drive of a lattice do
  // external work. In a lattice the kinetic energy of a grain is that of its motion beyond the mean strain. [energy]
  struct StepEnergies
  {
    double kinetic = 0, kinetic_change = 0, external_work = 0, friction_dissipation = 0, impact_dissipation = 0;
    double rolling_dissipation = 0; // by the couples of rolling resistance
    double correction_work     = 0; // share of -impact_dissipation that comes from a velocity correction of penetrations
  };

  // Stresses of a lattice during a step, at mid-step: (sxx, syy, sxy), positive in compression.
  struct LatticeStress
  {
    Eigen::Vector3d contacts = Eigen::Vector3d::Zero(); // sum of contact force x branch / area
    Eigen::Vector3d drive    = Eigen::Vector3d::Zero(); // that drives the cell: the same + inertia of the lattice / area
  };

  struct StepLedger
  {
    StepEnergies                 energies;
    std::vector<Eigen::Vector2d> wall_force;           // of each wall on the sample = impulse / step
    std::vector<double>          contact_impact;       // of each contact; the sum is energies.impact_dissipation [energy]
    std::vector<double>          contact_dissipation;  // of each contact; the sum is friction_dissipation + rolling_dissipation
    LatticeStress                lattice;              // 0 without a lattice
    double                       unbalanced_force = 0; // mean over grains of |m dv/h| / mean normal contact force
    double momentum_residual = 0; // |sum m dv - h F - impulses of walls and fixed grains| / (sum |r| + sum m |v|)
  };

  // A solved step: positions at mid-step, velocities before and after, contacts and forces.
  struct SolvedStep
  {
    const State                        &state;
    const ContactProblem               &problem;
    const std::vector<Contact>         &contacts;
    const std::vector<Impulse>         &impulses;
    const std::vector<int>             &acting;        // acting_contacts(impulses)
    const std::vector<Eigen::Vector2d> &applied_force; // on each grain
    const std::vector<BodyVelocity>    &v, &v_new;
    double                              step;
  };

  StepLedger step_ledger(const SolvedStep &solved, bool corrects_by_velocity);

  // Work of one contact at its bounds: while it slides and while it rolls. [energy]
  struct BoundWork
  {
    double sliding = 0, rolling = 0;
  };

  // step_ledger() counts all work of tangential impulses and couples as dissipation. With springs only that at the bounds is, one
  // entry per contact. The rest is elastic and joins the work along the normal.
  void count_springs(const std::vector<BoundWork> &lost, StepLedger &ledger);
} // namespace diptych::discrete
