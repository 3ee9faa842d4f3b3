// diptych: hardening = kinematic: critical_state whose mobilised stress ratio has a direction
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "continuum/laws/critical_state.h"

namespace diptych::continuum
{
  struct KinematicOptions : virtual CriticalStateOptions
  {
    double elastic_stress_ratio = 0.05; // half the elastic range of t/s after long shear [-]
  };

  template <class Visitor> void visit_parameters(KinematicOptions &o, Visitor &&visitor)
  {
    visitor("elastic_stress_ratio", o.elastic_stress_ratio, "-", {0.001, 0.9},
            "hardening = kinematic: half the elastic range of t/s after long shear");
  }

  // The yield surface is
  //   F = |q - p R| - p r,   p = s + cohesion/eta_c,
  // with the back stress ratio R, a vector like q (cone_law.h), and the radius r. Flow is along the unit vector n of q - p R. The
  // stress ratio along the flow is eta = n.R + r. With the plastic shear strain g (Armstrong and Frederick 1966):
  //   dR/dg = ((eta_p(nu) - r_e) n - R)/g_r,   dr/dg = (r_e - r)/g_r,
  //   d eps_v/dg = -sin psi = -((eta_p - eta_c)/beta - (eta_p - eta)).
  // R starts at zero and r at eta_0. Along a path without reversal |R| + r grows like the eta of critical_state, for any r_e.
  // After a reversal n.R is negative: the grains yield early and contract. r decays to r_e and is known from the sum of g.
  // Fully mobilised grains, eta = eta_p, dilate as in critical_state. Before that the dilatancy follows eta with slope one
  // (Taylor 1948): the dissipation p (eta - sin psi) depends on the density only, through (1 - 1/beta)(eta_p - eta_c) + eta_c.
  struct KinematicHardening : CriticalStateHardening
  {
    using Options                         = KinematicOptions;
    static constexpr const char name[]    = "kinematic";
    static constexpr const char meaning[] = "critical_state that unloads and reverses";
    static constexpr std::array keys      = {
           "critical_stress_ratio", "critical_solid_fraction", "strength_by_density", "dilatancy_ratio",
           "stress_ratio_start",    "solid_fraction_start",    "mobilisation_strain", "cohesion",
           "elastic_stress_ratio"};

    static void check(const KinematicOptions &o);
    KinematicHardening(const KinematicOptions &o, bool is_nonlocal);

    double radius(double equivalent_plastic_strain) const;

    double start, elastic; // eta_0, r_e [-]
    double possible;       // eta_p(nu_0) [-]
    double tension;        // pressure of the tip, cohesion/eta_c [pressure]
  };
} // namespace diptych::continuum
