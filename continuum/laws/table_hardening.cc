// diptych: hardening = table: strength from lists
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/table_hardening.h"

#include <algorithm>

namespace diptych::continuum
{
  namespace
  {
    constexpr double StrengthPoint::*strengths[] = {&StrengthPoint::friction, &StrengthPoint::dilatancy,
                                                    &StrengthPoint::cohesion};

    Strength interpolated(const std::vector<StrengthPoint> &table, const double strain_at)
    {
      const auto next = std::upper_bound(table.begin(), table.end(), strain_at,
                                         [](const double strain, const StrengthPoint &point) { return strain < point.strain; });
      if (next == table.begin() || next == table.end())
        {
          const StrengthPoint &end = next == table.begin() ? table.front() : table.back();
          return {end.friction, 0, end.dilatancy, 0, end.cohesion, 0};
        }
      const StrengthPoint &a = *(next - 1), &b = *next;
      const double         width = b.strain - a.strain, x = strain_at - a.strain;
      const double         friction = (b.friction - a.friction) / width, dilatancy = (b.dilatancy - a.dilatancy) / width;
      const double         cohesion = (b.cohesion - a.cohesion) / width;
      return {a.friction + friction * x, friction, a.dilatancy + dilatancy * x, dilatancy, a.cohesion + cohesion * x, cohesion};
    }
  } // namespace

  // Values are linear between the points, so checking the points is sufficient.
  void TableHardening::check(const TableOptions &o)
  {
    const std::size_t n = o.table_strain.size();
    require_keys(n > 0, {"table_strain", "hardening"}, "hardening = table needs table_strain, a list that ascends from 0");
    require_keys(o.table_friction_angle.size() == n && o.table_dilatancy_angle.size() == n && o.table_cohesion.size() == n,
                 {"table_strain", "table_friction_angle", "table_dilatancy_angle", "table_cohesion"},
                 "table_strain, table_friction_angle, table_dilatancy_angle, table_cohesion have ", n, ", ",
                 o.table_friction_angle.size(), ", ", o.table_dilatancy_angle.size(), ", ", o.table_cohesion.size(),
                 " values: they must be equally long");
    require_keys(o.table_strain[0] == 0, {"table_strain"}, "table_strain begins with ", o.table_strain[0],
                 ": it must ascend from 0");
    for (std::size_t k = 0; k < n; ++k)
      {
        require_keys(k == 0 || o.table_strain[k] > o.table_strain[k - 1], {"table_strain"}, "table_strain = ", o.table_strain[k],
                     " must be above the value before it");
        check_strength(concatenated("at table_strain = ", o.table_strain[k]),
                       {"table_dilatancy_angle", "table_friction_angle", "table_cohesion"}, o.table_friction_angle[k],
                       o.table_dilatancy_angle[k], o.table_cohesion[k]);
      }
  }

  // A rise read at the softening variable of m > 1 would soften at a constant kbar, and the solution would lose its length.
  TableHardening::TableHardening(const TableOptions &o, const bool is_nonlocal)
  {
    for (std::size_t k = 0; k < o.table_strain.size(); ++k)
      falls.push_back({o.table_strain[k], o.table_friction_angle[k] * one_degree, o.table_dilatancy_angle[k] * one_degree,
                       o.table_cohesion[k]});
    if (!is_nonlocal)
      return;
    rises.assign(falls.size(), {});
    for (std::size_t k = 1; k < falls.size(); ++k)
      for (double StrengthPoint::*value : strengths)
        rises[k].*value = std::max(0., falls[k].*value - falls[k - 1].*value);
    for (std::size_t k = 1; k < falls.size(); ++k)
      {
        rises[k].strain = falls[k].strain;
        for (double StrengthPoint::*value : strengths)
          {
            rises[k].*value += rises[k - 1].*value;
            falls[k].*value -= rises[k].*value;
          }
      }
  }

  Strength TableHardening::falling(const double kappa) const
  {
    return interpolated(falls, kappa);
  }

  Strength TableHardening::rising(const double kappa) const
  {
    return rises.empty() ? Strength() : interpolated(rises, kappa);
  }
} // namespace diptych::continuum
