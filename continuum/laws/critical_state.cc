// diptych: hardening = critical_state: strength and dilatancy follow solid fraction and mobilisation
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/critical_state.h"

#include <algorithm>
#include <cmath>

namespace diptych::continuum
{
  namespace
  {
    Rated cut_off(const double sine, const double rate)
    {
      constexpr double largest = CriticalStateHardening::largest_sine;
      return {std::clamp(sine, -largest, largest), std::abs(sine) > largest ? 0 : rate};
    }
  } // namespace

  // The densest and most mobilised state is either the initial one or the one that the initial density allows.
  void CriticalStateHardening::check(const CriticalStateOptions &o)
  {
    const double start    = o.start_solid_fraction();
    const double possible = o.critical_stress_ratio +
                            o.strength_by_density * o.critical_solid_fraction * std::log(start / o.critical_solid_fraction);
    for (const double ratio : {o.stress_ratio_start, possible})
      {
        const double sine = (ratio - o.critical_stress_ratio) / o.dilatancy_ratio;
        require_keys(sine <= std::max(ratio, 0.),
                     {"solid_fraction_start", "stress_ratio_start", "dilatancy_ratio", "critical_stress_ratio"},
                     "solid_fraction_start = ", start, ", stress_ratio_start = ", o.stress_ratio_start, ": at t/s = ", ratio,
                     " the sine of the dilatancy angle, ", sine,
                     ", exceeds t/s, so plastic work would be negative; increase dilatancy_ratio or critical_stress_ratio");
      }
  }

  CriticalStateHardening::CriticalStateHardening(const CriticalStateOptions &o, bool)
      : solid_fraction_start(o.start_solid_fraction()),
        stress_ratio(o.critical_stress_ratio),
        start_excess(o.stress_ratio_start - o.critical_stress_ratio),
        start_possible(o.strength_by_density * o.critical_solid_fraction *
                       std::log(o.start_solid_fraction() / o.critical_solid_fraction)),
        by_density(o.strength_by_density * o.critical_solid_fraction),
        dilatancy_ratio(o.dilatancy_ratio),
        mobilisation_strain(o.mobilisation_strain),
        cohesion(o.cohesion)
  {}

  double CriticalStateHardening::solid_fraction(const HardeningState &state) const
  {
    return solid_fraction_start * std::exp(state.densification);
  }

  CriticalStateHardening::Excess CriticalStateHardening::excess(const HardeningState &state) const
  {
    return {start_excess + state.stress_ratio_gain, start_possible + by_density * state.densification};
  }

  double CriticalStateHardening::dilation(const HardeningState &state) const
  {
    return excess(state).mobilised / dilatancy_ratio;
  }

  // sin phi = eta and sin psi = (eta - eta_c)/beta, both cut off.
  StrengthBySines CriticalStateHardening::sines(const HardeningState &state) const
  {
    const Excess e         = excess(state);
    const double rate      = (e.possible - e.mobilised) / mobilisation_strain;
    const double eta       = stress_ratio + e.mobilised;
    const Rated  friction  = cut_off(std::max(0., eta), eta > 0 ? rate : 0);
    const Rated  dilatancy = cut_off(dilation(state), rate / dilatancy_ratio);
    return {friction, dilatancy, {cohesion, 0}, cosine(friction.value)};
  }

  Rated CriticalStateHardening::mean_dilation(const HardeningState &start,
                                              const HardeningState &end,
                                              const double          multiplier) const
  {
    constexpr double short_step = 1e-6; // in a shorter step the densification is round-off; the midpoint value is exact to 1e-9
    if (multiplier > short_step)
      {
        const double mean = (start.densification - end.densification) / multiplier;
        return cut_off(mean, (dilation(end) - mean) / multiplier);
      }
    const HardeningState middle = after(start, 0.5 * multiplier);
    const Excess         e      = excess(middle);
    return cut_off(dilation(middle), 0.5 * (e.possible - e.mobilised) / (mobilisation_strain * dilatancy_ratio));
  }

  // y = eta - eta_c and z = eta_p - eta_c obey y' = (z - y)/g and z' = -w y with w = A nu_c / beta. M is the matrix of this
  // system, a = 1/(2 g) and q^2 = a^2 - w/g. The matrix exponential is e^(-a l) (cosh(q l) 1 + sinh(q l)/q (M + a 1)). If q^2 <
  // 0, cosine and sine replace cosh and sinh.
  HardeningState CriticalStateHardening::after(const HardeningState &state, const double multiplier) const
  {
    HardeningState end = state;
    end.equivalent_plastic_strain += multiplier;
    const Excess e = excess(state);
    const double l = multiplier, g = mobilisation_strain, a = 0.5 / g;
    const double w = by_density / dilatancy_ratio, square = a * a - w / g;
    const double q = std::sqrt(std::abs(square)), ql = q * l;
    // `even` and `odd` include the decay, which may be strong where cosh is large.
    double even = std::exp(-a * l), odd = l * even;
    if (ql > 1e-6 && square > 0)
      {
        const double slow = std::exp((q - a) * l), fast = std::exp(-(q + a) * l);
        even = 0.5 * (slow + fast);
        odd  = 0.5 * (slow - fast) / q;
      }
    else if (ql > 1e-6)
      {
        odd = even * std::sin(ql) / q;
        even *= std::cos(ql);
      }
    const double y = even * e.mobilised + odd * ((e.possible - e.mobilised) / g + a * e.mobilised);
    const double z = even * e.possible + odd * (a * e.possible - w * e.mobilised);
    end.stress_ratio_gain += y - e.mobilised;
    end.densification += (z - e.possible) / by_density;
    return end;
  }
} // namespace diptych::continuum
