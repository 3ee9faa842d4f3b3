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

    Strength interpolated(const std::vector<double> &strain, const std::vector<StrengthPoint> &table, const double strain_at)
    {
      const std::size_t next = std::upper_bound(strain.begin(), strain.end(), strain_at) - strain.begin();
      if (next == 0 || next == strain.size())
        return constant(next == 0 ? table.front() : table.back());
      const StrengthPoint &a = table[next - 1], &b = table[next];
      const double         width = strain[next] - strain[next - 1], x = strain_at - strain[next - 1];
      const auto           value = [&](const double from, const double to) {
        const double rate = (to - from) / width;
        return Rated{from + rate * x, rate};
      };
      return {value(a.friction, b.friction), value(a.dilatancy, b.dilatancy), value(a.cohesion, b.cohesion)};
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
      : strain(o.table_strain)
  {
    for (std::size_t k = 0; k < strain.size(); ++k)
      falls.push_back({o.table_friction_angle[k] * one_degree, o.table_dilatancy_angle[k] * one_degree, o.table_cohesion[k]});
    if (!is_nonlocal)
      return;
    rises.assign(falls.size(), {});
    for (std::size_t k = 1; k < falls.size(); ++k)
      for (double StrengthPoint::*value : strengths)
        rises[k].*value = std::max(0., falls[k].*value - falls[k - 1].*value);
    for (std::size_t k = 1; k < falls.size(); ++k)
      for (double StrengthPoint::*value : strengths)
        {
          rises[k].*value += rises[k - 1].*value;
          falls[k].*value -= rises[k].*value;
        }
  }

  Strength TableHardening::falling(const double kappa) const
  {
    return interpolated(strain, falls, kappa);
  }

  Strength TableHardening::rising(const double kappa) const
  {
    return rises.empty() ? Strength() : interpolated(strain, rises, kappa);
  }
} // namespace diptych::continuum
