// diptych: critical-state plasticity that unloads and reverses, classical and Cosserat
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>

#include "continuum/laws/cone_law.h"
#include "continuum/laws/kinematic_return.h"

namespace diptych::continuum
{
  // hardening = kinematic with the deviatoric vector and the pressure of cone_law.h; the equations are in kinematic_hardening.h.
  // KinematicState: back_stress_ratio is R as a stress (trace zero); stress_ratio_gain is |R| + r - eta_0, so that the mobilised
  // friction angle is found as for critical_state. Couple stress has a back stress like shear stress.
  class KinematicCone : public ConeLaw
  {
  public:
    KinematicCone(const LawOptions &options, ConeShape shape, bool is_cosserat);

    // Members as in ConeLaw.
    MaterialUpdate update(const MaterialState &s0, const Strain &d_strain, double d_time) const;
    double         yield_function(const MaterialState &state) const;
    double         shear_strength(const MaterialState &state) const; // |q| at yield in the present direction of q

  private:
    Deviatoric      back_ratio(const MaterialState &state) const;
    KinematicReturn moving_return(const Trial &trial, const Deviatoric &q, double d_time) const;
    Tangent         tangent_of(const KinematicReturn &end) const;

    KinematicHardening    kinematic;
    std::array<Stress, 5> unit; // stress of a unit entry of q
  };
} // namespace diptych::continuum
