// diptych: takes out what penetration a step has left
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/position_projection.h"

#include <algorithm>
#include <cmath>

namespace diptych::discrete
{
  namespace
  {
    double gap_of(const State &state, const Contact &c)
    {
      const Grains &g = state.grains;
      if (std::size_t(c.j) >= g.size())
        {
          const Wall &wall = state.walls[c.j - g.size()];
          return (g.position[c.i] - wall.point).dot(wall.normal) - g.radius[c.i];
        }
      const double dx = g.position[c.i].x() - g.position[c.j].x() - (c.image != 0 ? c.image * state.cell->width : 0.);
      const double dy = g.position[c.i].y() - g.position[c.j].y();
      return std::sqrt(dx * dx + dy * dy) - g.radius[c.i] - g.radius[c.j];
    }

    // Returns the penetration found.
    double part(State &state, const Contact &pair)
    {
      if (gap_of(state, pair) >= 0)
        return 0;
      Grains       &g     = state.grains;
      const Contact c     = make_contact(state, pair.i, pair.j);
      const bool    grain = std::size_t(c.j) < g.size();
      // What is free to move gives way, too: between walls that stood still grains would only hand their overlap on.
      const Eigen::Vector2d wall = grain ? Eigen::Vector2d::Zero() : state.walls[c.j - g.size()].inverse_mass();
      const double wi = g.inverse_mass(c.i), wj = grain ? g.inverse_mass(c.j) : wall.dot(c.normal.cwiseProduct(c.normal));
      const double across = c.image * c.normal.x(), wc = c.image != 0 ? state.cell->inverse_mass() : 0.;
      const double sum = wi + wj + wc * across * across;
      if (sum == 0)
        return 0;
      g.position[c.i] -= c.gap * wi / sum * c.normal;
      if (grain)
        g.position[c.j] += c.gap * wj / sum * c.normal;
      else
        state.walls[c.j - g.size()].point += c.gap / sum * wall.cwiseProduct(c.normal);
      if (wc > 0)
        state.cell->width += c.gap / sum * wc * across;
      return -c.gap;
    }
  } // namespace

  void project_positions(State &state, const std::vector<Contact> &contacts, const double enough)
  {
    constexpr int sweeps = 10;
    // g + h u' >= 0 at mid-step leaves at least g/2 now: pairs that stood open by much cannot have closed.
    const double        far   = 100 * enough;
    double              worst = 0;
    std::vector<int>    close;
    std::vector<double> gap; // of these now
    for (std::size_t k = 0; k < contacts.size(); ++k)
      if (contacts[k].gap < far)
        {
          close.push_back(int(k)), gap.push_back(gap_of(state, contacts[k]));
          worst = std::max(worst, -gap.back());
        }
    if (worst <= enough)
      return;
    // Parting one pair may close a neighbour that stands open by less.
    std::vector<Contact> near;
    for (std::size_t k = 0; k < close.size(); ++k)
      if (gap[k] < 2 * worst)
        near.push_back(contacts[close[k]]);
    for (int sweep = 0; sweep < sweeps && worst > enough; ++sweep)
      {
        worst = 0;
        for (const Contact &c : near)
          worst = std::max(worst, part(state, c));
      }
  }
} // namespace diptych::discrete
