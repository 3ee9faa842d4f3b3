// diptych: friction, dilatancy and cohesion as functions of plastic strain
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/hardening.h"

#include <algorithm>
#include <cmath>

#include "continuum/require.h"

namespace diptych::continuum
{
  namespace
  {
    constexpr double one_degree = 3.14159265358979323846 / 180;

    double cosine(const double sine)
    {
      return std::sqrt((1 - sine) * (1 + sine));
    }

    void add(Strength &s, const Strength &more)
    {
      s.friction += more.friction;
      s.friction_rate += more.friction_rate;
      s.dilatancy += more.dilatancy;
      s.dilatancy_rate += more.dilatancy_rate;
      s.cohesion += more.cohesion;
      s.cohesion_rate += more.cohesion_rate;
    }

    // A square root gives the cosine faster than std::cos. All angles lie between -90 and 90 degrees.
    StrengthBySines by_sines(const Strength &s)
    {
      const double sin_phi = std::sin(s.friction), sin_psi = std::sin(s.dilatancy), cos_phi = cosine(sin_phi);
      return {sin_phi,    cos_phi * s.friction_rate, sin_psi, cosine(sin_psi) * s.dilatancy_rate,
              s.cohesion, s.cohesion_rate,           cos_phi};
    }
  } // namespace

  Hardening::Hardening(const LawOptions &options, const Units &units, const double nonlocal_weight)
      : nonlocal_weight(nonlocal_weight)
  {
    validate(options);
    require_keys(nonlocal_weight == 0 || options.hardening != HardeningKind::critical_state, {"hardening", "law"},
                 "hardening = critical_state has no gradient law: take another hardening or a Cosserat law");
    const LawOptions o = in_units(options, units);
    peak               = {0, o.friction_angle_peak * one_degree, o.dilatancy_angle_peak * one_degree, o.cohesion};
    residual           = {0, o.friction_angle_residual * one_degree, o.dilatancy_angle_residual * one_degree,
                          o.cohesion_residual.value_or(o.cohesion)};
    softening_strain   = o.softening_strain;
    if (o.hardening == HardeningKind::mobilisation)
      {
        unmobilised         = (o.friction_angle_peak - o.friction_angle_start) * one_degree;
        mobilisation_strain = o.mobilisation_strain;
      }
    if (follows_solid_fraction(o.hardening))
      {
        const double start = o.solid_fraction_start.value_or(o.critical_solid_fraction);
        critical_state     = {true,
                              start,
                              o.critical_stress_ratio,
                              o.stress_ratio_start - o.critical_stress_ratio,
                              o.strength_by_density * o.critical_solid_fraction * std::log(start / o.critical_solid_fraction),
                              o.strength_by_density * o.critical_solid_fraction,
                              o.dilatancy_ratio,
                              o.mobilisation_strain};
      }
    if (o.hardening == HardeningKind::constant)
      table = {peak};
    if (o.hardening == HardeningKind::table)
      for (std::size_t k = 0; k < o.table_strain.size(); ++k)
        table.push_back({o.table_strain[k], o.table_friction_angle[k] * one_degree, o.table_dilatancy_angle[k] * one_degree,
                         o.table_cohesion[k]});
    if (nonlocal_weight > 0)
      separate_rises();
  }

  // A rise read at the softening variable of m > 1 would soften at a constant kbar, and the solution would lose its length.
  void Hardening::separate_rises()
  {
    rises.assign(table.size(), {});
    for (std::size_t k = 1; k < table.size(); ++k)
      for (double Point::*value : {&Point::friction, &Point::dilatancy, &Point::cohesion})
        rises[k].*value = std::max(0., table[k].*value - table[k - 1].*value);
    for (std::size_t k = 1; k < table.size(); ++k)
      {
        rises[k].strain = table[k].strain;
        for (double Point::*value : {&Point::friction, &Point::dilatancy, &Point::cohesion})
          {
            rises[k].*value += rises[k - 1].*value;
            table[k].*value -= rises[k].*value;
          }
      }
  }

  Strength Hardening::angles_at(const HardeningState &state) const
  {
    Strength s = softened(state, 1 - nonlocal_weight);
    add(s, risen(state));
    return s;
  }

  double Hardening::softening_variable(const HardeningState &state) const
  {
    if (nonlocal_weight == 0)
      return state.equivalent_plastic_strain;
    return std::max((1 - nonlocal_weight) * state.equivalent_plastic_strain + nonlocal_weight * state.nonlocal_plastic_strain,
                    0.);
  }

  Strength Hardening::softened(const HardeningState &state, double share) const
  {
    const double strain = softening_variable(state);
    Strength     s      = table.empty() ? decayed(strain) : interpolated(table, strain);
    if (nonlocal_weight > 0 && strain == 0)
      share = 0;
    for (double *rate : {&s.friction_rate, &s.dilatancy_rate, &s.cohesion_rate})
      *rate *= share;
    return s;
  }

  Strength Hardening::risen(const HardeningState &state) const
  {
    if (!rises.empty())
      return interpolated(rises, state.equivalent_plastic_strain);
    if (unmobilised == 0)
      return {};
    const double lacks = unmobilised * std::exp(-state.equivalent_plastic_strain / mobilisation_strain);
    return {-lacks, lacks / mobilisation_strain};
  }

  Strength Hardening::at(const HardeningState &state) const
  {
    if (!critical_state.is_on)
      return angles_at(state);
    const StrengthBySines s = critical(state);
    return {std::asin(s.friction),
            s.friction_rate / s.friction_cosine,
            std::asin(s.dilatancy),
            s.dilatancy_rate / cosine(s.dilatancy),
            s.cohesion,
            s.cohesion_rate};
  }

  StrengthBySines Hardening::sines_at(const HardeningState &state) const
  {
    return critical_state.is_on ? critical(state) : by_sines(angles_at(state));
  }

  StrengthBySines Hardening::sines_by_nonlocal(const HardeningState &state) const
  {
    Strength       s = softened(state, nonlocal_weight);
    const Strength r = risen(state);
    add(s, {r.friction, 0, r.dilatancy, 0, r.cohesion, 0});
    return by_sines(s);
  }

  double Hardening::solid_fraction(const HardeningState &state) const
  {
    return critical_state.is_on ? critical_state.solid_fraction * std::exp(state.densification) : 0;
  }

  Hardening::Excess Hardening::excess(const HardeningState &state) const
  {
    return {critical_state.start_excess + state.stress_ratio_gain,
            critical_state.start_possible + critical_state.by_density * state.densification};
  }

  // sin phi = eta and sin psi = (eta - eta_c)/beta, both cut off.
  StrengthBySines Hardening::critical(const HardeningState &state) const
  {
    const Excess   e         = excess(state);
    const double   rate      = (e.possible - e.mobilised) / critical_state.mobilisation_strain;
    const double   eta       = critical_state.stress_ratio + e.mobilised;
    const Dilation friction  = cut_off(std::max(0., eta), eta > 0 ? rate : 0);
    const Dilation dilatancy = cut_off(dilation(state), rate / critical_state.dilatancy_ratio);
    return {friction.sine, friction.rate, dilatancy.sine, dilatancy.rate, peak.cohesion, 0, cosine(friction.sine)};
  }

  Dilation Hardening::cut_off(const double sine, const double rate)
  {
    return {std::clamp(sine, -largest_sine, largest_sine), std::abs(sine) > largest_sine ? 0 : rate};
  }

  double Hardening::dilation(const HardeningState &state) const
  {
    return excess(state).mobilised / critical_state.dilatancy_ratio;
  }

  std::optional<Dilation> Hardening::mean_dilation(const HardeningState &start,
                                                   const HardeningState &end,
                                                   const double          multiplier) const
  {
    if (!critical_state.is_on)
      return {};
    constexpr double short_step = 1e-6; // in a shorter step the densification is round-off; the midpoint value is exact to 1e-9
    if (multiplier > short_step)
      {
        const double mean = (start.densification - end.densification) / multiplier;
        return cut_off(mean, (dilation(end) - mean) / multiplier);
      }
    const HardeningState middle = after(start, 0.5 * multiplier);
    const Excess         e      = excess(middle);
    return cut_off(dilation(middle),
                   0.5 * (e.possible - e.mobilised) / (critical_state.mobilisation_strain * critical_state.dilatancy_ratio));
  }

  // y = eta - eta_c and z = eta_p - eta_c obey y' = (z - y)/g and z' = -w y with w = A nu_c / beta. M is the matrix of this
  // system, a = 1/(2 g) and q^2 = a^2 - w/g. The matrix exponential is e^(-a l) (cosh(q l) 1 + sinh(q l)/q (M + a 1)). If q^2 <
  // 0, cosine and sine replace cosh and sinh.
  HardeningState Hardening::after(const HardeningState &state, const double multiplier) const
  {
    HardeningState end = state;
    end.equivalent_plastic_strain += multiplier;
    if (!critical_state.is_on)
      return end;
    const Excess e = excess(state);
    const double l = multiplier, g = critical_state.mobilisation_strain, a = 0.5 / g;
    const double w = critical_state.by_density / critical_state.dilatancy_ratio, square = a * a - w / g;
    const double q = std::sqrt(std::abs(square)), ql = q * l;
    // Both include the decay, which may be strong where cosh is large.
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
    end.densification += (z - e.possible) / critical_state.by_density;
    return end;
  }

  // v(kappa) = v_r + (v_p - v_r) exp(-kappa/kappa_s); friction less (phi_p - phi_0) exp(-kappa/kappa_m) where it is mobilised.
  Strength Hardening::decayed(const double softening_variable) const
  {
    const double decay = std::exp(-softening_variable / softening_strain), rate = -decay / softening_strain;
    const double friction = peak.friction - residual.friction, dilatancy = peak.dilatancy - residual.dilatancy;
    const double cohesion = peak.cohesion - residual.cohesion;
    return {residual.friction + friction * decay, friction * rate, residual.dilatancy + dilatancy * decay, dilatancy * rate,
            residual.cohesion + cohesion * decay, cohesion * rate};
  }

  Strength Hardening::interpolated(const std::vector<Point> &table, const double strain_at)
  {
    const auto next = std::upper_bound(table.begin(), table.end(), strain_at,
                                       [](const double strain, const Point &point) { return strain < point.strain; });
    if (next == table.begin() || next == table.end())
      {
        const Point &end = next == table.begin() ? table.front() : table.back();
        return {end.friction, 0, end.dilatancy, 0, end.cohesion, 0};
      }
    const Point &a = *(next - 1), &b = *next;
    const double width = b.strain - a.strain, x = strain_at - a.strain;
    const double friction = (b.friction - a.friction) / width, dilatancy = (b.dilatancy - a.dilatancy) / width;
    const double cohesion = (b.cohesion - a.cohesion) / width;
    return {a.friction + friction * x, friction, a.dilatancy + dilatancy * x, dilatancy, a.cohesion + cohesion * x, cohesion};
  }
} // namespace diptych::continuum
