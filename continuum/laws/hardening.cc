// diptych: how friction, dilatancy and cohesion change with plastic strain
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/hardening.h"

#include <algorithm>
#include <cmath>

namespace diptych::continuum
{
  namespace
  {
    constexpr double degree = 3.14159265358979323846 / 180;
  }

  Hardening::Hardening(const LawOptions &options, const Units &units)
  {
    validate(options);
    const LawOptions o = in_units(options, units);
    peak               = {0, o.friction_angle_peak * degree, o.dilatancy_angle_peak * degree, o.cohesion};
    residual           = {0, o.friction_angle_residual * degree, o.dilatancy_angle_residual * degree,
                          o.cohesion_residual.value_or(o.cohesion)};
    softening_strain   = o.softening_strain;
    if (o.hardening == HardeningKind::mobilisation)
      {
        unmobilised         = (o.friction_angle_peak - o.friction_angle_start) * degree;
        mobilisation_strain = o.mobilisation_strain;
      }
    if (o.hardening == HardeningKind::constant)
      table = {peak};
    if (o.hardening == HardeningKind::table)
      for (std::size_t k = 0; k < o.table_strain.size(); ++k)
        table.push_back(
          {o.table_strain[k], o.table_friction_angle[k] * degree, o.table_dilatancy_angle[k] * degree, o.table_cohesion[k]});
  }

  Strength Hardening::at(const double equivalent_plastic_strain) const
  {
    return table.empty() ? decayed(equivalent_plastic_strain) : interpolated(equivalent_plastic_strain);
  }

  // v(kappa) = v_r + (v_p - v_r) exp(-kappa/kappa_s); friction less (phi_p - phi_0) exp(-kappa/kappa_m) where it is mobilised.
  Strength Hardening::decayed(const double equivalent_plastic_strain) const
  {
    const double decay = std::exp(-equivalent_plastic_strain / softening_strain), rate = -decay / softening_strain;
    const double friction = peak.friction - residual.friction, dilatancy = peak.dilatancy - residual.dilatancy;
    const double cohesion = peak.cohesion - residual.cohesion;
    const double lacks    = unmobilised == 0 ? 0 : unmobilised * std::exp(-equivalent_plastic_strain / mobilisation_strain);
    return {residual.friction + friction * decay - lacks, friction * rate + lacks / mobilisation_strain,
            residual.dilatancy + dilatancy * decay,       dilatancy * rate,
            residual.cohesion + cohesion * decay,         cohesion * rate};
  }

  Strength Hardening::interpolated(const double equivalent_plastic_strain) const
  {
    const auto next = std::upper_bound(table.begin(), table.end(), equivalent_plastic_strain,
                                       [](const double strain, const Point &point) { return strain < point.strain; });
    if (next == table.begin() || next == table.end())
      {
        const Point &end = next == table.begin() ? table.front() : table.back();
        return {end.friction, 0, end.dilatancy, 0, end.cohesion, 0};
      }
    const Point &a = *(next - 1), &b = *next;
    const double width = b.strain - a.strain, x = equivalent_plastic_strain - a.strain;
    const double friction = (b.friction - a.friction) / width, dilatancy = (b.dilatancy - a.dilatancy) / width;
    const double cohesion = (b.cohesion - a.cohesion) / width;
    return {a.friction + friction * x, friction, a.dilatancy + dilatancy * x, dilatancy, a.cohesion + cohesion * x, cohesion};
  }
} // namespace diptych::continuum
