// diptych: explicit smooth contacts (penalty method), for comparison with the non-smooth scheme
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
            "normal contact stiffness kn / P of penalty and compliant (there 1e4 unless given, which is near to rigid); overlaps "
            "are about d / penalty_stiffness; the tangential stiffness is half of it");
    visitor("penalty_step_fraction", o.step_fraction, "-", {1e-6, 10.},
            "step / sqrt(m_min/kn); frictionless samples blow up from 0.9-1.0 on, sticking ones from 0.75; energy errors grow "
            "unnoticed "
            "from 0.55 on");
    visitor("penalty_damping", o.damping, "-", {0., 1.},
            "penalty and compliant: damping of the normal dashpot as a fraction of the critical damping of the two bodies; there "
            "is no other damping");
    visitor(
      "penalty_preload", o.preload, "d sqrt(rho/P)", {0., 1e6},
      "time in which the springs take up the stress of the preparation before the loading (compliant: the longest time, and only "
      "a prepared sample); 0: no preload. loading/mode = time has no preload");
    visitor("penalty_preload_friction", o.preload_friction, "-", {0., 100.},
            "penalty: Coulomb coefficient of all contacts during the preload");
  }

  // Step fraction x sqrt(m_min / stiffness), where m_min is the smallest mass of a free grain. [time] `stiffness` kn is a force
  // per overlap and unit thickness [pressure]. Free walls do not count: their mass should be at least m_min times the number of
  // grains that press on them. Throws std::invalid_argument if no grain is free.
  double penalty_step(const Grains &grains, double stiffness, double fraction);

  // Data that penalty steps keep besides the State. A checkpoint does not need them: State::impulses hold the tangential
  // springs, the positions the normal ones. The neighbour list changes no bit. A run resumed with a fresh PenaltyState and the
  // same step therefore gives the same bits.
  struct PenaltyState
  {
    // State::impulses divided by this step give forces; 0: the step of the setting. Set it only if the last step of the State had
    // another length. Its impulses then start as springs; clear them to start without springs.
    double impulse_step = 0;

    NeighbourList  neighbours;
    ContactProblem problem; // reused for its memory
  };

  // One step of length setting.step (Cundall & Strack 1979). The leapfrog has the form of `advance`, so that momentum and the
  // ledger balance to round-off:
  //   q_m = q + (h/2) v;  f at q_m;  v' = v + h M^-1 (F + f);  q' = q_m + (h/2) v'.
  // This is the trajectory of velocity Verlet: its half-step velocities are v, v' and its positions are the q_m. The order is 2
  // without damping, and the scheme is stable for h < 2/omega_max. A closed contact with overlap -g carries
  //   f_n = max(0, -kn g - 2 beta sqrt(kn m_eff) u_n),  f_t = f_t of the last step - (kn/2) h u_t  clamped to +-mu f_n;
  // and, with rolling resistance, a couple R f_m from a third spring of the same kind, as of Iwashita & Oda (1998), k_r = kt R^2:
  //   f_m = f_m of the last step - (kn/2) h w  clamped to +-mu_r (l/R) f_n.
  // At a constant step h u_t is the tangential displacement since the last q_m. Impulses are h f, with signs and arms as in
  // ContactRow. Contacts (only closed ones, ascending) and applied forces belong to q_m. Forces of drives are taken at the middle
  // of the step, prescribed velocities at its end.
  //
  // Energies are those of StepLedger with two differences. friction_dissipation and rolling_dissipation, also per contact, are
  // only the work at the bound. To close the ledger, impact_dissipation contains the dashpots and the CHANGE OF THE ELASTIC
  // ENERGY of all springs.
  //
  // The method does not iterate: `solve` is converged with no sweeps. In a blow-up a grain is not finite or travels more than
  // its radius in a step. Then `solve` is blown_up with an infinite residual, and the state stays unchanged. Throws
  // std::invalid_argument if kn = options.stiffness x setting.pressure or the step is not positive.
  // `with_ledger` = false saves the time of the ledger, whose part of the result then is empty.
  StepResult advance_penalty(State                &state,
                             PenaltyState         &penalty,
                             const StepSetting    &setting,
                             const PenaltyOptions &options,
                             bool                  with_ledger = true);
} // namespace diptych::discrete
