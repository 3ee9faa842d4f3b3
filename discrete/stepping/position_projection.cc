// diptych: takes out what penetration a step has left
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/stepping/position_projection.h"

#include <algorithm>
#include <cmath>

#include "discrete/stepping/position_kernel.h"

namespace diptych::discrete
{
  namespace
  {
    // What of a contact the sweeps need: they look at many.
    struct Pair
    {
      int    i, j, image;
      double gap; // now
    };

    template <class ContactOrPair> double gap_of(const State &state, const ContactOrPair &c)
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
    double part(State &state, const Pair &pair)
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
      struct Count
      {
        std::size_t discs = 0, others = 0;
      };
      std::vector<FourPairs> discs;  // two grains each, neither an image
      std::vector<Pair>      others; // with walls, across the edge of a cell
      std::vector<Count>     ends;   // of each round that has others, and of the last
    };

    bool is_of_discs(const Pair &c, const int n_grains)
    {
      return c.j < n_grains && c.image == 0;
    }

    // Round of each pair, the earliest possible.
    std::vector<int> earliest_rounds(const State &state, const std::vector<Pair> &pairs)
    {
      const int        n = int(state.grains.size()), cell = n + int(state.walls.size());
      const bool       free_width = state.cell && state.cell->inverse_mass() > 0;
      std::vector<int> next(cell + 1, 0), round(pairs.size());
      const auto stands = [&](const int j) { return j >= n && state.walls[j - n].inverse_mass() == Eigen::Vector2d::Zero(); };
      for (std::size_t k = 0; k < pairs.size(); ++k)
        {
          const Pair &c = pairs[k];
          int        &i = next[c.i], &j = stands(c.j) ? i : next[c.j], &width = free_width && c.image != 0 ? next[cell] : i;
          round[k] = std::max({i, j, width});
          i = j = width = round[k] + 1;
        }
      return round;
    }

    // Empty lanes take the disc after the last grain.
    Rounds make_rounds(const State &state, const std::vector<Pair> &pairs)
    {
      const int                  n     = int(state.grains.size());
      const std::vector<int>     round = earliest_rounds(state, pairs);
      std::vector<Rounds::Count> place(1 + *std::max_element(round.begin(), round.end())); // in each round
      for (std::size_t k = 0; k < pairs.size(); ++k)
        ++(is_of_discs(pairs[k], n) ? place[round[k]].discs : place[round[k]].others);

      // From the number in each round to the lane where it begins.
      Rounds        rounds;
      Rounds::Count end;
      for (Rounds::Count &c : place)
        {
          const Rounds::Count begin{end.discs * pairs_at_once, end.others};
          end.discs += (c.discs + pairs_at_once - 1) / pairs_at_once, end.others += c.others;
          if (c.others > 0)
            rounds.ends.push_back(end);
          c = begin;
        }
      rounds.ends.push_back(end);
      rounds.discs.assign(end.discs, {{n, n, n, n}, {n, n, n, n}});
      rounds.others.resize(end.others);
      for (std::size_t k = 0; k < pairs.size(); ++k)
        {
          const Pair    &c = pairs[k];
          Rounds::Count &p = place[round[k]];
          if (is_of_discs(c, n))
            {
              FourPairs &four                 = rounds.discs[p.discs / pairs_at_once];
              four.i[p.discs % pairs_at_once] = c.i, four.j[p.discs % pairs_at_once] = c.j, ++p.discs;
            }
          else
            rounds.others[p.others++] = c;
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
    double part(State &state, const Pair &pair, std::vector<Disc> &discs)
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
      double        worst = 0;
      Rounds::Count begin;
      for (const Rounds::Count &end : rounds.ends)
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
    const double      far   = 100 * enough;
    double            worst = 0;
    std::vector<Pair> near;
    near.reserve(contacts.size());
    for (const Contact &c : contacts)
      if (c.gap < far)
        {
          near.push_back({c.i, c.j, c.image, gap_of(state, c)});
          worst = std::max(worst, -near.back().gap);
        }
    if (worst <= enough)
      return;
    // Parting one pair may close a neighbour that stands open by less.
    near.erase(std::remove_if(near.begin(), near.end(), [worst](const Pair &c) { return c.gap >= 2 * worst; }), near.end());

    const Rounds      rounds = make_rounds(state, near);
    std::vector<Disc> discs  = discs_of(state.grains);
    for (int k = 0; k < sweeps && worst > enough; ++k)
      worst = sweep(rounds, state, discs);
    for (std::size_t i = 0; i < state.grains.size(); ++i)
      state.grains.position[i] = {discs[i].x, discs[i].y};
  }
} // namespace diptych::discrete
