// diptych: hardening = constant, exponential and mobilisation: strength stays, decays, or rises first
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/decay_hardening.h"

#include <cmath>

namespace diptych::continuum
{
  namespace
  {
    StrengthPoint peak_of(const DecayOptions &o)
    {
      return {o.friction_angle_peak * one_degree, o.dilatancy_angle_peak * one_degree, o.cohesion};
    }
  } // namespace

  void ConstantHardening::check(const DecayOptions &o)
  {
    check_strength("at the peak", {"dilatancy_angle_peak", "friction_angle_peak", "cohesion"}, o.friction_angle_peak,
                   o.dilatancy_angle_peak, o.cohesion);
  }

  ConstantHardening::ConstantHardening(const DecayOptions &o, bool)
      : peak(peak_of(o))
  {}

  // All values decay with the same factor, so checking both ends is sufficient.
  void ExponentialHardening::check(const DecayOptions &o)
  {
    ConstantHardening::check(o);
    const double cohesion = o.cohesion_residual.value_or(o.cohesion);
    require_keys(o.friction_angle_residual <= o.friction_angle_peak, {"friction_angle_residual", "friction_angle_peak"},
                 "friction_angle_residual = ", o.friction_angle_residual,
                 " must not exceed friction_angle_peak = ", o.friction_angle_peak);
    require_keys(o.dilatancy_angle_residual <= o.dilatancy_angle_peak, {"dilatancy_angle_residual", "dilatancy_angle_peak"},
                 "dilatancy_angle_residual = ", o.dilatancy_angle_residual,
                 " must not exceed dilatancy_angle_peak = ", o.dilatancy_angle_peak);
    require_keys(cohesion <= o.cohesion, {"cohesion_residual", "cohesion"}, "cohesion_residual = ", cohesion,
                 " must not exceed cohesion = ", o.cohesion);
    check_strength("after long shear", {"dilatancy_angle_residual", "friction_angle_residual", "cohesion_residual"},
                   o.friction_angle_residual, o.dilatancy_angle_residual, cohesion);
  }

  ExponentialHardening::ExponentialHardening(const DecayOptions &o, bool)
      : peak(peak_of(o)),
        residual{o.friction_angle_residual * one_degree, o.dilatancy_angle_residual * one_degree,
                 o.cohesion_residual.value_or(o.cohesion)},
        softening_strain(o.softening_strain)
  {}

  Strength ExponentialHardening::falling(const double kappa) const
  {
    const double decay = std::exp(-kappa / softening_strain), rate = -decay / softening_strain;
    const auto   value = [&](const double from, const double to) { return Rated{to + (from - to) * decay, (from - to) * rate}; };
    return {value(peak.friction, residual.friction), value(peak.dilatancy, residual.dilatancy),
            value(peak.cohesion, residual.cohesion)};
  }

  // phi - psi is a + b exp(-k/k_s) - c exp(-k/k_m), which has at most one stationary point. Checking that point and both ends
  // is sufficient.
  void MobilisationHardening::check(const DecayOptions &o)
  {
    ExponentialHardening::check(o);
    require_keys(o.friction_angle_start <= o.friction_angle_peak, {"friction_angle_start", "friction_angle_peak"},
                 "friction_angle_start = ", o.friction_angle_start,
                 " must not exceed friction_angle_peak = ", o.friction_angle_peak);
    check_strength("at the start", {"dilatancy_angle_peak", "friction_angle_start", "cohesion"}, o.friction_angle_start,
                   o.dilatancy_angle_peak, o.cohesion);
    const double b      = o.friction_angle_peak - o.friction_angle_residual - o.dilatancy_angle_peak + o.dilatancy_angle_residual;
    const double c      = o.friction_angle_peak - o.friction_angle_start;
    const double decay  = 1 / o.mobilisation_strain - 1 / o.softening_strain;
    const double strain = std::log(c * o.softening_strain / (b * o.mobilisation_strain)) / decay;
    if (!(b > 0 && c > 0 && std::isfinite(strain) && strain > 0))
      return;
    const double softened = std::exp(-strain / o.softening_strain), lacks = c * std::exp(-strain / o.mobilisation_strain);
    check_strength(concatenated("at a hardening variable of ", strain),
                   {"dilatancy_angle_peak", "friction_angle_peak", "dilatancy_angle_residual", "friction_angle_residual",
                    "friction_angle_start", "mobilisation_strain"},
                   o.friction_angle_residual + (o.friction_angle_peak - o.friction_angle_residual) * softened - lacks,
                   o.dilatancy_angle_residual + (o.dilatancy_angle_peak - o.dilatancy_angle_residual) * softened, 1);
  }

  MobilisationHardening::MobilisationHardening(const DecayOptions &o, const bool is_nonlocal)
      : ExponentialHardening(o, is_nonlocal),
        unmobilised((o.friction_angle_peak - o.friction_angle_start) * one_degree),
        mobilisation_strain(o.mobilisation_strain)
  {}

  Strength MobilisationHardening::rising(const double kappa) const
  {
    const double lacks = unmobilised * std::exp(-kappa / mobilisation_strain);
    return {{-lacks, lacks / mobilisation_strain}, {}, {}};
  }
} // namespace diptych::continuum
