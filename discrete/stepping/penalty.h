// diptych: explicit smooth contacts (penalty), against which the non-smooth scheme is charted
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "discrete/stepping/time_stepping.h"

namespace diptych::discrete
{
  struct PenaltyOptions
  {
    double stiffness        = 1000;
    double step_fraction    = 0.2;
    double damping          = 0.2;
    double preload          = 30;
    double preload_friction = 0;
  };

  template <class Visitor> void visit_parameters(PenaltyOptions &o, Visitor &&visitor)
  {
    visitor("penalty_stiffness", o.stiffness, "-", {1., 1e12},
            "normal contact stiffness kn / P; overlaps are about d / (this); the tangential stiffness is half of it");
    visitor("penalty_step_fraction", o.step_fraction, "-", {1e-6, 10.},
            "step / sqrt(m_min/kn); frictionless samples blow up from 0.9-1.0 on, sticking ones from 0.75, and silent heating "
            "starts at 0.55");
    visitor("penalty_damping", o.damping, "-", {0., 1.},
            "normal dashpot of a contact, fraction of the critical one of its two bodies; there is no other damping");
    visitor(
      "penalty_preload", o.preload, "d sqrt(rho/P)", {0., 1e6},
      "time in which the springs take up the pressure before the loading, platens at rest; 0: not at all. loading/mode = time "
      "has none");
    visitor("penalty_preload_friction", o.preload_friction, "-", {0., 100.}, "Coulomb coefficient of all contacts in that time");
  }

  // Step fraction x sqrt(m_min / stiffness), m_min the smallest mass of a grain that moves. [time]
  // `stiffness` kn is a force per overlap and unit thickness [pressure]. A free wall is no grain: its mass should be at
  // least m_min times the number of grains that press on it. Throws std::invalid_argument where no grain moves.
  double penalty_step(const Grains &grains, double stiffness, double fraction);

  // What penalty steps keep beside the State. All of it can be left out of a checkpoint: tangential springs live in
  // State::impulses, normal ones in the positions, and the neighbour list is a cache that does not change a bit of the result. So
  // a run resumed from its State with a fresh PenaltyState and an unchanged step goes on with the same bits.
  struct PenaltyState
  {
    // Step by which State::impulses are divided to give forces; 0: that of the setting. To be set by a caller only where the
    // last step of the State was of another length (its impulses then start as springs; clear them to start without).
    double impulse_step = 0;

    NeighbourList neighbours;
  };

  // One step of length setting.step (Cundall & Strack 1979) by the leapfrog in the form of `advance`, so that momentum
  // and the ledger balance to round-off:
  //   q_m = q + (h/2) v;  f at q_m;  v' = v + h M^-1 (F + f);  q' = q_m + (h/2) v'.
  // This is the trajectory of velocity Verlet (its half-step velocities are v, v', its positions the q_m); order 2 without
  // damping, stable for h < 2/omega_max. A closed contact with overlap -g carries
  //   f_n = max(0, -kn g - 2 beta sqrt(kn m_eff) u_n),  f_t = f_t of the last step - (kn/2) h u_t  clamped to +-mu f_n;
  // at a constant step h u_t is the tangential displacement since the last q_m. Impulses are h f, signs and arms as in
  // ContactRow. Contacts (closed ones only, ascending) and applied forces are those at q_m. Forces of drives are taken at the
  // middle of the step, prescribed velocities at its end.
  //
  // Energies are those of StepLedger, but friction_dissipation, also that of each contact, is the work of sliding alone;
  // impact_dissipation is that of the dashpots PLUS THE CHANGE OF THE ELASTIC ENERGY of both springs, so that the ledger still
  // closes to round-off.
  //
  // Nothing is iterated: `solve` is converged with no sweeps, or, where a grain is not finite or travels more than its radius
  // in a step (blow-up), blown_up with an infinite residual; the state then stays as it was.
  // Throws std::invalid_argument where kn = options.stiffness x setting.pressure or the step is not positive.
  StepResult advance_penalty(State &state, PenaltyState &penalty, const StepSetting &setting, const PenaltyOptions &options);
} // namespace diptych::discrete
