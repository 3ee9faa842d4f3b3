// diptych: takes out what penetration a step has left
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/position_projection.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "discrete/position_kernel.h"

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

    // Pairs in rounds: those of one round share no body that moves, and each comes after all pairs that stood before it and
    // share one with it. Taken round by round they give the same bits as one by one, but four at a time.
    struct Rounds
    {
      struct End
      {
        std::size_t discs, others;
      };
      std::vector<FourPairs> discs;  // two grains each, neither an image
      std::vector<Contact>   others; // with walls, across the edge of a cell
      std::vector<End>       ends;   // of each round
    };

    // Round of each pair, the earliest possible.
    std::vector<int> earliest_rounds(const State &state, const std::vector<Contact> &pairs)
    {
      const int        n = int(state.grains.size()), cell = n + int(state.walls.size());
      const bool       free_width = state.cell && state.cell->inverse_mass() > 0;
      std::vector<int> next(cell + 1, 0), round(pairs.size());
      const auto stands = [&](const int j) { return j >= n && state.walls[j - n].inverse_mass() == Eigen::Vector2d::Zero(); };
      for (std::size_t k = 0; k < pairs.size(); ++k)
        {
          const Contact &c = pairs[k];
          int           &i = next[c.i], &j = stands(c.j) ? i : next[c.j], &width = free_width && c.image != 0 ? next[cell] : i;
          round[k] = std::max({i, j, width});
          i = j = width = round[k] + 1;
        }
      return round;
    }

    // Empty lanes take the disc after the last grain.
    Rounds make_rounds(const State &state, const std::vector<Contact> &pairs)
    {
      const int              n        = int(state.grains.size());
      const std::vector<int> round    = earliest_rounds(state, pairs);
      const int              n_rounds = 1 + *std::max_element(round.begin(), round.end());
      std::vector<int>       start(n_rounds + 1, 0), order(pairs.size());
      for (const int r : round)
        ++start[r + 1];
      std::partial_sum(start.begin(), start.end(), start.begin());
      std::vector<int> next(start.begin(), start.end() - 1);
      for (std::size_t k = 0; k < pairs.size(); ++k)
        order[next[round[k]]++] = int(k);

      Rounds rounds;
      rounds.discs.reserve(pairs.size() / pairs_at_once + n_rounds);
      for (int r = 0; r < n_rounds; ++r)
        {
          int filled = pairs_at_once;
          for (int k = start[r]; k < start[r + 1]; ++k)
            {
              const Contact &c = pairs[order[k]];
              if (c.j >= n || c.image != 0)
                {
                  rounds.others.push_back(c);
                  continue;
                }
              if (filled == pairs_at_once)
                rounds.discs.push_back({{n, n, n, n}, {n, n, n, n}}), filled = 0;
              rounds.discs.back().i[filled] = c.i, rounds.discs.back().j[filled] = c.j;
              ++filled;
            }
          rounds.ends.push_back({rounds.discs.size(), rounds.others.size()});
        }
      return rounds;
    }

    std::vector<Disc> discs_of(const Grains &g)
    {
      std::vector<Disc> discs(g.size() + 1);
      for (std::size_t i = 0; i < g.size(); ++i)
        discs[i] = {g.position[i].x(), g.position[i].y(), g.radius[i], g.inverse_mass(i)};
      discs.back() = {0, 0, 0, 0};
      return discs;
    }

    // part() where `discs` and not the state know the present positions.
    double part(State &state, const Contact &pair, std::vector<Disc> &discs)
    {
      const int n = int(state.grains.size());
      for (const int body : {pair.i, pair.j})
        if (body < n)
          state.grains.position[body] = {discs[body].x, discs[body].y};
      const double penetration = part(state, pair);
      for (const int body : {pair.i, pair.j})
        if (body < n)
          discs[body].x = state.grains.position[body].x(), discs[body].y = state.grains.position[body].y();
      return penetration;
    }

    // Returns the largest penetration that it met.
    double sweep(const Rounds &rounds, State &state, std::vector<Disc> &discs)
    {
      double      worst = 0;
      Rounds::End begin{0, 0};
      for (const Rounds::End &end : rounds.ends)
        {
          worst = part_discs(rounds.discs.data() + begin.discs, end.discs - begin.discs, discs.data(), worst);
          for (std::size_t k = begin.others; k < end.others; ++k)
            worst = std::max(worst, part(state, rounds.others[k], discs));
          begin = end;
        }
      return worst;
    }
  } // namespace

  void project_positions(State &state, const std::vector<Contact> &contacts, const double enough)
  {
    constexpr int sweeps = 10;
    // g + h u' >= 0 at mid-step leaves at least g/2 now: pairs that stood open by much cannot have closed.
    const double        far   = 100 * enough;
    double              worst = 0;
    std::vector<double> gap(contacts.size()); // now
    for (std::size_t k = 0; k < contacts.size(); ++k)
      {
        gap[k] = contacts[k].gap < far ? gap_of(state, contacts[k]) : std::numeric_limits<double>::infinity();
        worst  = std::max(worst, -gap[k]);
      }
    if (worst <= enough)
      return;
    // Parting one pair may close a neighbour that stands open by less.
    std::vector<Contact> near;
    for (std::size_t k = 0; k < contacts.size(); ++k)
      if (gap[k] < 2 * worst)
        near.push_back(contacts[k]);

    const Rounds      rounds = make_rounds(state, near);
    std::vector<Disc> discs  = discs_of(state.grains);
    for (int k = 0; k < sweeps && worst > enough; ++k)
      worst = sweep(rounds, state, discs);
    for (std::size_t i = 0; i < state.grains.size(); ++i)
      state.grains.position[i] = {discs[i].x, discs[i].y};
  }
} // namespace diptych::discrete
