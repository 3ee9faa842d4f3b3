// diptych: scalar return to a hardening cone, the kernel of all plastic laws
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "continuum/laws/law.h"
#include "continuum/laws/yield_cone.h"

namespace diptych::continuum
{
  // Path of plastic flow from a trial state, a function of the multiplier lambda. With d, the dilation of the cone over lambda:
  //   t(lambda) = shear    - (shear_loss    + shear_loss_by_dilation    d) lambda,
  //   s(lambda) = pressure + (pressure_gain + pressure_gain_by_dilation d) lambda.
  // A radial return has shear_loss = G, pressure_gain_by_dilation = B and nothing else. All in [pressure].
  struct ReturnPath
  {
    double shear = 0, pressure = 0; // t >= 0 and s (compression positive) of the trial
    double shear_loss = 0, shear_loss_by_dilation = 0;
    double pressure_gain = 0, pressure_gain_by_dilation = 0;
  };

  // The hardening at the start of a step and the cone there.
  struct ConeStart
  {
    HardeningState hardening;
    Cone           cone;
  };

  // End of the return and its derivatives by the trial's shear t0 and pressure s0.
  struct ConeReturn
  {
    double  multiplier = 0, multiplier_by_shear = 0, multiplier_by_pressure = 0;
    double  shear = 0, shear_by_shear = 0, shear_by_pressure = 0;
    double  pressure = 0, pressure_by_shear = 0, pressure_by_pressure = 0;
    Rated   dilation;       // of the cone over the step
    double  overstress = 0; // viscous_modulus * multiplier [pressure]
    Regime  regime     = Regime::plastic;
    Verdict verdict    = Verdict::reliable;
  };

  // Solves F(lambda) = t - s slope - intercept - viscous_modulus lambda = 0 with the cone at the end of the step. Newton's
  // iteration starts at lambda = 0, stays inside a bracket and converges to 1e-13 of the trial stress. F must be positive at
  // lambda = 0. If F is still positive when t has shrunk to zero, the stress returns to the tip of the cone: t = 0, s =
  // -(intercept + viscous_modulus lambda)/slope. This is examined only where the pressure may become negative on the way.
  // Opening at the tip adds nothing to lambda, so the answer is continuous in the trial stress.
  // The verdict is `unreliable` if -dF/dlambda < 0.1 `reference_modulus` at the root or at lambda = 0. It is `failed` if no
  // root was found or F(0) <= 0.
  ConeReturn return_to_cone(const YieldCone  &cone,
                            const ConeStart  &start,
                            const ReturnPath &path,
                            double            viscous_modulus,
                            double            reference_modulus);
} // namespace diptych::continuum
