// diptych: return to a cone whose axis follows the flow, for loads that unload and reverse
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <deal.II/base/tensor.h>

#include "continuum/laws/kinematic_hardening.h"
#include "continuum/laws/law.h"

namespace diptych::continuum
{
  using DeviatoricRatio = dealii::Tensor<1, 5>; // deviatoric vector of cone_law.h over the pressure [-]

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
