// diptych: hardening = kinematic: critical_state whose mobilised stress ratio has a direction
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/kinematic_hardening.h"

#include <cmath>

namespace diptych::continuum
{
  void KinematicHardening::check(const KinematicOptions &o)
  {
    CriticalStateHardening::check(o);
    require_keys(o.elastic_stress_ratio < o.critical_stress_ratio, {"elastic_stress_ratio", "critical_stress_ratio"},
                 "elastic_stress_ratio = ", o.elastic_stress_ratio,
                 " must be below critical_stress_ratio = ", o.critical_stress_ratio);
  }

  KinematicHardening::KinematicHardening(const KinematicOptions &o, const bool is_nonlocal)
      : CriticalStateHardening(o, is_nonlocal),
        start(o.stress_ratio_start),
        elastic(o.elastic_stress_ratio),
        possible(stress_ratio + start_possible),
        tension(o.cohesion / o.critical_stress_ratio)
  {}

  double KinematicHardening::radius(const double equivalent_plastic_strain) const
  {
    return elastic + (start - elastic) * std::exp(-equivalent_plastic_strain / mobilisation_strain);
  }
} // namespace diptych::continuum
