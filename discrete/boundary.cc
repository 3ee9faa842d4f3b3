// diptych: what acts on the free lateral boundary of the grain sample
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/boundary.h"

#include <algorithm>
#include <cmath>

namespace diptych::discrete
{
  namespace
  {
    void share_force(const Grains                 &grains,
                     const int                    *begin,
                     const int                    *end,
                     const double                  total,
                     std::vector<Eigen::Vector2d> &force)
    {
      double mass = 0;
      for (const int *i = begin; i != end; ++i)
        mass += grains.mass[*i];
      for (const int *i = begin; i != end; ++i)
        force[*i].x() += total * grains.mass[*i] / mass;
    }
  } // namespace

  void add_lateral_forces(const State                  &state,
                          const LateralOptions         &options,
                          const double                  pressure,
                          const double                  mean_diameter,
                          std::vector<Eigen::Vector2d> &force)
  {
    if (options.lateral == "none" || state.walls.size() < 2)
      return;
    const Grains &g      = state.grains;
    const double  bottom = state.walls[0].point.y(), height = state.walls[1].point.y() - bottom;
    const int     n_bands = std::max(1, int(std::lround(height / (options.band_height * mean_diameter))));
    const double  w       = height / n_bands;

    std::vector<std::vector<int>> band(n_bands);
    for (std::size_t i = 0; i < g.size(); ++i)
      band[std::clamp(int((g.position[i].y() - bottom) / w), 0, n_bands - 1)].push_back(int(i));

    for (std::vector<int> &members : band)
      {
        // Equal abscissae would leave the order to the sort: the grain number decides.
        std::sort(members.begin(), members.end(), [&](const int a, const int b) {
          return g.position[a].x() != g.position[b].x() ? g.position[a].x() < g.position[b].x() : a < b;
        });
        const std::size_t n = std::min<std::size_t>(options.end_grains, members.size() / 2);
        if (n == 0)
          continue;
        share_force(g, members.data(), members.data() + n, w * pressure, force);
        share_force(g, members.data() + members.size() - n, members.data() + members.size(), -w * pressure, force);
      }
  }
} // namespace diptych::discrete
