// diptych: positions and velocities of bodies in a step
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/stepping/body_motion.h"

#include "discrete/contacts/lattice_motion.h"

namespace diptych::discrete
{
  void drift(State &state, const double duration)
  {
    Grains &g = state.grains;
    std::visit([&](auto &kind) { kind.drift(duration, g.position); }, state.periodicity);
    for (std::size_t i = 0; i < g.size(); ++i)
      {
        g.position[i] += duration * g.velocity[i];
        g.rotation[i] += duration * g.spin[i];
      }
    for (Wall &wall : state.walls)
      wall.point += duration * wall.velocity;
  }

  void take_velocities(const std::vector<BodyVelocity> &v, State &state)
  {
    Grains           &g = state.grains;
    const std::size_t n = g.size();
    for (std::size_t i = 0; i < n; ++i)
      {
        if (g.fixed[i])
          continue;
        g.velocity[i] = {v[i].x, v[i].y};
        g.spin[i]     = v[i].surface / g.radius[i];
      }
    for (std::size_t w = 0; w < state.walls.size(); ++w)
      state.walls[w].velocity = {v[n + w].x, v[n + w].y};
    carry_platen_grains(state);
    if (PeriodicWidth *periodic = state.width(); periodic && periodic->moves())
      periodic->velocity = v.back().x;
    if (Lattice *lattice = state.lattice())
      {
        lattice->rate                  = rate_of(v.back());
        const Eigen::Matrix2d gradient = velocity_gradient(lattice->rate);
        for (std::size_t i = 0; i < n; ++i)
          g.velocity[i] -= gradient * g.position[i];
      }
  }

  void keep_impulses(const std::vector<Contact> &contacts,
                     const std::vector<Impulse> &impulses,
                     const std::vector<Impulse> &previous,
                     const std::vector<int>     &acting,
                     State                      &state)
  {
    state.impulses.clear();
    state.impulses.reserve(acting.size());
    for (const int k : acting)
      {
        const Impulse &r = impulses[k], &before = previous[k];
        PairImpulse    pair{contacts[k].i, contacts[k].j, r.normal, r.tangential};
        pair.rolling = r.rolling;
        if (before.normal > 0 && r.normal > 0)
          {
            pair.normal_change     = r.normal - before.normal;
            pair.tangential_change = r.tangential - before.tangential;
            pair.rolling_change    = r.rolling - before.rolling;
          }
        state.impulses.push_back(pair);
      }
  }
} // namespace diptych::discrete
