// diptych: one Moreau-Jean step of Non-Smooth Contact Dynamics
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>
#include <optional>

#include "discrete/bodies/boundary.h"
#include "discrete/contacts/contact_detection.h"
#include "discrete/stepping/grain_stress_error.h"
#include "discrete/solvers/solver.h"
#include "discrete/stepping/step_ledger.h"

namespace diptych::discrete
{
  struct ContactLawOptions
  {
    double friction               = 0.4;
    double platen_friction        = 0.9;
    double normal_restitution     = 0;
    double tangential_restitution = 0;
    double wall_friction          = 0;
  };

  template <class Visitor> void visit_parameters(ContactLawOptions &o, Visitor &&visitor)
  {
    visitor("friction", o.friction, "-", {0., 100.}, "Coulomb coefficient between grains");
    visitor("platen_friction", o.platen_friction, "-", {0., 100.},
            "Coulomb coefficient at the platens; greater than `friction`, or the sample slides along them");
    visitor("wall_friction", o.wall_friction, "-", {0., 100.}, "Coulomb coefficient at rigid side walls");
    visitor("normal_restitution", o.normal_restitution, "-", {0., 1.},
            "e_n = (1-w)/w of Moreau's weighted average velocity; 0: inelastic");
    visitor("tangential_restitution", o.tangential_restitution, "-", {-1., 1.}, "e_t, likewise for the tangential velocity");
  }

  // What undoes interpenetration.
  enum class PenetrationCorrection
  {
    projection,    // position sweeps after the step
    velocity,      // gap/h in the normal term
    soft_velocity, // 0.2 gap/h
    none
  };

  constexpr auto choices(PenetrationCorrection)
  {
    return std::array{
      std::pair{PenetrationCorrection::projection, "projection"}, std::pair{PenetrationCorrection::velocity, "velocity"},
      std::pair{PenetrationCorrection::soft_velocity, "soft_velocity"}, std::pair{PenetrationCorrection::none, "none"}};
  }

  struct StepOptions
  {
    std::optional<double> step                   = 1.; // none: auto
    PenetrationCorrection penetration_correction = PenetrationCorrection::projection;
    double                gravity_x              = 0;
    double                gravity_y              = 0;
  };

  template <class Visitor> void visit_parameters(StepOptions &o, Visitor &&visitor)
  {
    visitor("step", o.step, "time", {1e-12, 1e12},
            "step h, at most d sqrt(rho/P) with free end grains, shortened so that every stage is a whole number of steps; auto: "
            "chosen at the start of every stage from forces, motion and tolerance (discrete/README.md)");
    visitor("penetration_correction", o.penetration_correction, "-",
            "what undoes interpenetration: up to ten position sweeps after the step, or gap/h (soft_velocity: 0.2 gap/h) in the "
            "normal term, whose work is a ledger column");
    visitor("gravity_x", o.gravity_x, "length/time^2", {-1e12, 1e12}, "horizontal acceleration of gravity, on grains");
    visitor("gravity_y", o.gravity_y, "length/time^2", {-1e12, 1e12}, "vertical acceleration of gravity, on grains");
  }

  // All that a step needs besides the state.
  struct StepSetting
  {
    double            step = 1; // h [time]
    StepOptions       time;     // its `step` is what the user asked for
    ContactLawOptions law;
    SolverOptions     solver;
    LateralCondition  lateral;
    double            pressure           = 1;     // of the containing action
    double            mean_diameter      = 1;     // [length]
    bool              accept_unconverged = false; // only while a sample is prepared
  };

  // What one step hands to the next to save work; results do not depend on it.
  struct StepCache
  {
    NeighbourList               neighbours;
    ContactProblem              problem; // for its memory
    std::shared_ptr<ThreadTeam> team = std::make_shared<ThreadTeam>(1);
  };

  struct [[nodiscard]] StepResult
  {
    SolveReport                    solve;
    std::vector<Contact>           contacts;      // at mid-step, ascending in (i, j)
    std::vector<Impulse>           impulses;      // of each contact
    std::vector<Eigen::Vector2d>   applied_force; // on each grain: containing action and gravity
    std::vector<Eigen::Vector2d>   wall_force;    // of each wall on the sample = impulse / step
    StepEnergies                   energies;
    std::vector<double>            contact_dissipation;     // by friction, of each contact; sum: energies.friction_dissipation
    std::vector<double>            contact_impact;          // likewise, normal to the contact; sum: energies.impact_dissipation
    double                         largest_penetration = 0; // at mid-step [length]
    double                         momentum_residual   = 0; // see StepLedger
    double                         unbalanced_force    = 0; // mean over grains of |m dv/h| / mean normal contact force
    std::optional<SampledAccuracy> accuracy;                // where the step was sampled
  };

  // Advances the state by one step (Moreau 1988, Jean 1999, theta = 1/2):
  //   q_m = q + (h/2) v; contacts found there; v_f = v + h M^-1 F; impulses r solved; v' = v_f + M^-1 H r;
  //   q' = q_m + (h/2) v'; penetrations corrected.
  // Normal term: c_n = e_n u_n for an impact (u_n < 0 and the gap is or would be closed), max(g, 0)/h otherwise, so that
  // g + h u_n' >= 0 is exactly the gap at the next q_m. Detection margin of a grain: 0.04 d + 1.2 h (|v| + h |F|/m).
  // Where the solver does not converge the state stays as it was, unless accept_unconverged is set.
  // `sample`: solve further, until the grains' stress is as accurate as the request says.
  StepResult advance(State &state, const StepSetting &setting, StepCache &cache, const SampleRequest *sample = nullptr);
  StepResult advance(State &state, const StepSetting &setting);

  // Lateral action and gravity on each grain at the present positions; nothing on fixed grains. [pressure x length]
  std::vector<Eigen::Vector2d> applied_forces(const State &state, const StepSetting &setting);

  // Of the grains; of all bodies, free walls and a free cell width included.
  double kinetic_energy(const Grains &grains);
  double kinetic_energy(const State &state);
} // namespace diptych::discrete
