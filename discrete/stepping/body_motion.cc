// diptych: positions and velocities of bodies in a step
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/stepping/body_motion.h"

#include <cmath>

#include "discrete/contacts/lattice_motion.h"

namespace diptych::discrete
{
  namespace
  {
    // Exponential of a symmetric matrix.
    Eigen::Matrix2d exponential(const Eigen::Matrix2d &a)
    {
      const double          mean = 0.5 * a.trace(), d = 0.5 * (a(0, 0) - a(1, 1)), s = std::hypot(d, a(0, 1));
      const Eigen::Matrix2d deviator = a - mean * Eigen::Matrix2d::Identity();
      return std::exp(mean) * (std::cosh(s) * Eigen::Matrix2d::Identity() + (s > 0 ? std::sinh(s) / s : 1.) * deviator);
    }

    // Takes the shorter of the equivalent lattice vectors (Lagrange), so that the heights of the parallelogram stay large.
    void reduce(Eigen::Matrix2d &a)
    {
      for (const int k : {0, 1})
        if (const double times = std::round(a.col(0).dot(a.col(1)) / a.col(k).squaredNorm()); times != 0)
          a.col(1 - k) -= times * a.col(k);
    }

    void deform(State &state, const double duration)
    {
      Lattice              &lattice = *state.lattice;
      const Eigen::Matrix2d map     = exponential(duration * velocity_gradient(lattice.rate));
      for (Eigen::Vector2d &x : state.grains.position)
        x = map * x;
      lattice.vectors = map * lattice.vectors;
      lattice.strain += duration * lattice.rate;
      reduce(lattice.vectors);
    }
  } // namespace

  void drift(State &state, const double duration)
  {
    Grains &g = state.grains;
    if (state.lattice)
      deform(state, duration);
    for (std::size_t i = 0; i < g.size(); ++i)
      {
        g.position[i] += duration * g.velocity[i];
        g.rotation[i] += duration * g.spin[i];
      }
    for (Wall &wall : state.walls)
      wall.point += duration * wall.velocity;
    if (state.cell)
      state.cell->width += duration * state.cell->velocity;
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
    if (state.cell && state.cell->moves())
      state.cell->velocity = v.back().x;
    if (state.lattice)
      {
        state.lattice->rate            = rate_of(v.back());
        const Eigen::Matrix2d gradient = velocity_gradient(state.lattice->rate);
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
