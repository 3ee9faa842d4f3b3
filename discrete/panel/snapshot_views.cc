// diptych: grains and contact forces of a snapshot as grids for ParaView
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/panel/snapshot_views.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "discrete/files/field_arrays.h"
#include "discrete/snapshot_fields.h"

namespace diptych::discrete
{
  namespace
  {
    VtuGrid cells_of(std::vector<Eigen::Vector2d> points, const VtkCell type)
    {
      VtuGrid grid{std::move(points), {}, type, {}};
      grid.cells.resize(grid.points.size());
      std::iota(grid.cells.begin(), grid.cells.end(), 0u);
      return grid;
    }

    // Values that are missing at every point are left out.
    void add_field(VtuGrid &grid, const std::string &name, const unsigned int n_components, std::vector<double> values)
    {
      if (values.empty() || !std::all_of(values.begin(), values.end(), [](const double x) { return std::isnan(x); }))
        grid.fields.push_back({name, n_components, std::move(values), true});
    }
  } // namespace

  VtuGrid grains_of(const Snapshot &s)
  {
    VtuGrid grid = cells_of(s.position, VtkCell::vertex);
    visit_grain_fields(s, [&](const std::string &name, const auto &values, const char *, const char *) {
      constexpr int n = n_components<typename std::decay_t<decltype(values)>::value_type>;
      if (n < 9 && name != "grains/position" && name != "grains/mean_spin_term" && name != "grains/applied_force")
        add_field(grid, name.substr(name.find('/') + 1), n, flat(values));
    });
    std::vector<double> mean_stress;
    for (std::size_t i = 0; i < s.radius.size(); ++i)
      mean_stress.push_back(0.5 * s.internal_moment[i].trace() / (M_PI * s.radius[i] * s.radius[i]));
    add_field(grid, "mean_stress", 1, mean_stress);
    return grid;
  }

  VtuGrid contacts_of(const Snapshot &s)
  {
    std::vector<Eigen::Vector2d> ends;
    std::vector<double>          normal, tangential, gap, status;
    for (std::size_t k = 0; k < s.contacts.size(); ++k)
      {
        const ContactForce &c = s.contacts[k];
        if (c.force == Eigen::Vector2d::Zero())
          continue;
        const bool is_wall = std::size_t(c.j) >= s.position.size();
        ends.push_back(s.position[std::size_t(c.i)]);
        ends.push_back(is_wall ? c.point : s.position[std::size_t(c.j)] + Eigen::Vector2d(c.shift, c.shift_y));
        normal.insert(normal.end(), 2, c.force.dot(c.normal));
        tangential.insert(tangential.end(), 2, c.force.dot(Eigen::Vector2d(-c.normal.y(), c.normal.x())));
        gap.insert(gap.end(), 2, s.gap[k]);
        status.insert(status.end(), 2, double(s.status[k]));
      }
    VtuGrid grid = cells_of(std::move(ends), VtkCell::line);
    add_field(grid, "normal_force", 1, normal);
    add_field(grid, "tangential_force", 1, tangential);
    add_field(grid, "gap", 1, gap);
    add_field(grid, "status", 1, status);
    return grid;
  }
} // namespace diptych::discrete
