// diptych: return to a cone whose axis follows the flow, for loads that unload and reverse
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <deal.II/base/tensor.h>

#include "continuum/laws/law.h"
#include "continuum/laws/options.h"

namespace diptych::continuum
{
  using DeviatoricRatio = dealii::Tensor<1, 5>; // deviatoric vector of cone_law.h over the pressure [-]

  // hardening = kinematic: critical_state (hardening.h) with a mobilised stress ratio that has a direction. The yield surface is
  //   F = |q - p R| - p r,   p = s + cohesion/eta_c,
  // with the back stress ratio R, a vector like q, and the radius r. Flow is along the unit vector n of q - p R. The stress ratio
  // along the flow is eta = n.R + r. With the plastic shear strain g (Armstrong and Frederick 1966):
  //   dR/dg = ((eta_p(nu) - r_e) n - R)/g_r,   dr/dg = (r_e - r)/g_r,
  //   d eps_v/dg = -sin psi = -((eta_p - eta_c)/beta - (eta_p - eta)).
  // R starts at zero and r at eta_0. Along a path without reversal |R| + r grows like the eta of critical_state, for any r_e.
  // After a reversal n.R is negative: the grains yield early and contract. r decays to r_e and is known from the sum of g.
  // Fully mobilised grains, eta = eta_p, dilate as in critical_state. Before that the dilatancy follows eta with slope one
  // (Taylor 1948): the dissipation p (eta - sin psi) depends on the density only, through (1 - 1/beta)(eta_p - eta_c) + eta_c.
  struct KinematicHardening
  {
    explicit KinematicHardening(const LawOptions &options);

    double radius(double equivalent_plastic_strain) const;

    double critical, start, elastic; // eta_c, eta_0, r_e [-]
    double possible, by_density;     // eta_p(nu_0) [-]; A nu_c, d eta_p / d ln nu [-]
    double dilatancy_ratio, strain;  // beta, g_r [-]
    double tension;                  // pressure of the tip, cohesion/eta_c [pressure]
  };

  struct KinematicTrial
  {
    dealii::Tensor<1, 5> q;                                                // [pressure]
    double               pressure = 0;                                     // p, shifted by the tension of the tip [pressure]
    DeviatoricRatio      back;                                             // R of the start
    double               equivalent_plastic_strain = 0, densification = 0; // of the start
    double               shear_modulus = 0, pressure_modulus = 0, viscous_modulus = 0; // [pressure]
  };

  // End of the step with its derivatives by the trial's q and p.
  struct KinematicReturn
  {
    double               multiplier = 0, dilation = 0; // lambda; mean sine of the dilatancy angle
    dealii::Tensor<1, 5> q;
    double               pressure = 0;
    DeviatoricRatio      back;
    dealii::Tensor<2, 5> q_by_q;
    dealii::Tensor<1, 5> q_by_pressure, pressure_by_q;
    double               pressure_by_pressure = 0;
    Regime               regime               = Regime::plastic;
    Verdict              verdict              = Verdict::failed;
  };

  // Implicit in n, nu and psi; exact in the decay of R and r along a constant n. Unknowns are lambda and sin psi; sin psi is cut
  // off at 0.95. F must be positive at the trial. If q - p R vanishes before F does, the stress returns to the tip. The
  // verdict is `unreliable` under the condition of cone_return.h.
  KinematicReturn return_to_moving_cone(const KinematicHardening &hardening, const KinematicTrial &trial);
} // namespace diptych::continuum
