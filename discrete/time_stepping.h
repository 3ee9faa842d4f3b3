// diptych: one Moreau-Jean step of Non-Smooth Contact Dynamics
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "discrete/boundary.h"
#include "discrete/contact_detection.h"
#include "discrete/solvers/solver.h"

namespace diptych::discrete
{
  struct ContactLawOptions
  {
    double friction               = 0.4;
    double platen_friction        = 0.9;
    double normal_restitution     = 0;
    double tangential_restitution = 0;
  };

  template <class Visitor> void visit_parameters(ContactLawOptions &o, Visitor &&visitor)
  {
    visitor("friction", o.friction, "-", {0., 100.}, "Coulomb coefficient between grains");
    visitor("platen_friction", o.platen_friction, "-", {0., 100.},
            "Coulomb coefficient at the platens; greater than `friction`, or the sample slides along them");
    visitor("normal_restitution", o.normal_restitution, "-", {0., 1.},
            "e_n = (1-w)/w of Moreau's weighted average velocity; 0: inelastic");
    visitor("tangential_restitution", o.tangential_restitution, "-", {-1., 1.}, "e_t, likewise for the tangential velocity");
  }

  struct StepOptions
  {
    double      step                   = 1;
    std::string penetration_correction = "projection";
    double      gravity_x              = 0;
    double      gravity_y              = 0;
  };

  template <class Visitor> void visit_parameters(StepOptions &o, Visitor &&visitor)
  {
    visitor("step", o.step, "time", {1e-12, 1e12},
            "step h; at most d sqrt(rho/P) with free end grains. Shortened so that every stage is a whole number of steps");
    visitor("penetration_correction", o.penetration_correction, "-", {"projection", "velocity", "soft_velocity", "none"},
            "what undoes interpenetration: ten position sweeps after the step, or gap/h (soft_velocity: 0.2 gap/h) in the "
            "normal term, whose work is a ledger column");
    visitor("gravity_x", o.gravity_x, "length/time^2", {-1e12, 1e12}, "horizontal acceleration of gravity");
    visitor("gravity_y", o.gravity_y, "length/time^2", {-1e12, 1e12}, "vertical acceleration of gravity");
  }

  // All that a step needs besides the state.
  struct StepSetting
  {
    StepOptions       time;
    ContactLawOptions law;
    SolverOptions     solver;
    LateralOptions    lateral;
    double            pressure           = 1;     // of the containing action
    double            mean_diameter      = 1;     // [length]
    bool              accept_unconverged = false; // only while a sample is prepared
  };

  // Work of one step. kinetic_change = external_work - friction_dissipation - impact_dissipation to round-off, because
  // momentum is balanced over the step: sum r.(u + u')/2 is the work of the impulses. [energy]
  struct StepEnergies
  {
    double kinetic = 0, kinetic_change = 0, external_work = 0, friction_dissipation = 0, impact_dissipation = 0;
    double correction_work = 0; // share of -impact_dissipation that a velocity correction of penetrations put in
  };

  struct [[nodiscard]] StepResult
  {
    SolveReport                  solve;
    std::vector<Contact>         contacts;      // at mid-step, in sweep order
    std::vector<Impulse>         impulses;      // of each contact
    std::vector<Eigen::Vector2d> applied_force; // on each grain: containing action and gravity
    std::vector<Eigen::Vector2d> wall_force;    // of each wall on the sample = impulse / step
    StepEnergies                 energies;
    double                       largest_penetration = 0; // at mid-step [length]
    double                       momentum_residual   = 0; // |sum m dv - h F - wall impulses| / sum of |contact impulses|
  };

  // Advances the state by one step (DESIGN, discrete panel; Moreau 1988, Jean 1999, theta = 1/2):
  //   q_m = q + (h/2) v; contacts found there; v_f = v + h M^-1 F; impulses r solved; v' = v_f + M^-1 H r;
  //   q' = q_m + (h/2) v'; penetrations corrected.
  // Normal term: c_n = e_n u_n for an impact (u_n < 0 and the gap is or would be closed), max(g, 0)/h otherwise, so that
  // g + h u_n' >= 0 is exactly the gap at the next q_m. Detection margin of a grain: 0.04 d + 1.2 h (|v| + h |F|/m).
  // Where the solver does not converge the state stays as it was, unless accept_unconverged is set.
  StepResult advance(State &state, const StepSetting &setting);

  double kinetic_energy(const Grains &grains);
} // namespace diptych::discrete
