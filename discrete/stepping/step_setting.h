// diptych: data that a step needs besides the state
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>

#include "discrete/bodies/boundary.h"
#include "discrete/solvers/solver_options.h"

namespace diptych::discrete
{
  struct ContactLawOptions
  {
    double friction               = 0.4;
    double platen_friction        = 0.9;
    double normal_restitution     = 0;
    double tangential_restitution = 0;
    double wall_friction          = 0;
    double rolling_friction = 0, platen_rolling_friction = 0, wall_rolling_friction = 0;
  };

  // One friction at grains, platens and walls, without restitution and rolling friction.
  inline ContactLawOptions same_friction(const double friction)
  {
    ContactLawOptions law;
    law.friction = law.platen_friction = law.wall_friction = friction;
    return law;
  }

  template <class Visitor> void visit_parameters(ContactLawOptions &o, Visitor &&visitor)
  {
    visitor("friction", o.friction, "-", {0., 100.}, "Coulomb coefficient between grains");
    visitor("platen_friction", o.platen_friction, "-", {0., 100.},
            "Coulomb coefficient at the platens; below `friction` the sample slides along them");
    visitor("wall_friction", o.wall_friction, "-", {0., 100.}, "Coulomb coefficient at rigid side walls");
    visitor(
      "rolling_friction", o.rolling_friction, "-", {0., 10.},
      "coefficient of rolling resistance between grains: the couple of a contact is at most this x the harmonic mean of the two "
      "radii x the normal force; 0: none. The preparation of a sample has none");
    visitor("platen_rolling_friction", o.platen_rolling_friction, "-", {0., 10.},
            "coefficient of rolling resistance at the platens; the length is the radius of the grain");
    visitor("wall_rolling_friction", o.wall_rolling_friction, "-", {0., 10.},
            "coefficient of rolling resistance at rigid side walls; the length is the radius of the grain");
    visitor("normal_restitution", o.normal_restitution, "-", {0., 1.},
            "Newton's restitution coefficient in the normal direction; 0: no rebound, 1: elastic");
    visitor("tangential_restitution", o.tangential_restitution, "-", {-1., 1.},
            "Newton's restitution coefficient in the tangential direction; 0: no rebound, 1: elastic");
  }

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
    std::optional<double> step                   = {}; // none: auto
    PenetrationCorrection penetration_correction = PenetrationCorrection::projection;
    double                gravity_x              = 0;
    double                gravity_y              = 0;
  };

  template <class Visitor> void visit_parameters(StepOptions &o, Visitor &&visitor)
  {
    visitor(
      "step", o.step, "time", {1e-12, 1e12},
      "step h, at most d sqrt(rho/P) with free end grains; it is shortened so that every stage is a whole number of steps. auto: "
      "chosen at the start of every stage from forces, motion and accuracy (discrete/README.md)");
    visitor("penetration_correction", o.penetration_correction, "-",
            "method that removes interpenetration: up to ten position sweeps after the step (projection), or gap/h (velocity) or "
            "0.2 gap/h (soft_velocity) in the normal term, whose work is a column of the ledger");
    visitor("gravity_x", o.gravity_x, "length/time^2", {-1e12, 1e12},
            "horizontal acceleration of gravity; it acts on grains only");
    visitor("gravity_y", o.gravity_y, "length/time^2", {-1e12, 1e12}, "vertical acceleration of gravity; it acts on grains only");
  }

  // Springs of the contacts, taken implicitly over the step: method = compliant.
  struct Compliance
  {
    double stiffness = 0; // kn [pressure]; 0: the contacts are rigid
    double damping   = 0; // of the normal dashpot, as a fraction of the critical damping of the two bodies
  };

  // kt / kn of springs; the springs of couples have kt, too.
  constexpr double tangential_over_normal_stiffness = 0.5;

  struct StepSetting
  {
    double            step = 1; // h [time]
    StepOptions       stepping; // its `step` is the value from the scene
    ContactLawOptions law;
    SolverOptions     solver;
    Compliance        compliance;
    LateralCondition  lateral;
    double            pressure           = 1;     // of the lateral action
    double            mean_diameter      = 1;     // [length]
    bool              accept_unconverged = false; // only during the preparation of a sample
  };
} // namespace diptych::discrete
