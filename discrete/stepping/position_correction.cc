// diptych: removal of the penetration that a step leaves
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/stepping/position_correction.h"

#include <algorithm>

#include "discrete/contacts/contact_law.h"
#include "discrete/contacts/lattice_motion.h"
#include "discrete/solvers/batched_sweep.h"

namespace diptych::discrete
{
  namespace
  {
    std::vector<double> gaps_to_come(const SolvedContacts &s)
    {
      std::vector<double> gap(s.contacts.size());
      for (std::size_t k = 0; k < gap.size(); ++k)
        gap[k] = s.contacts[k].gap + s.step * relative_velocity(s.problem.contacts[k], s.v_new).normal;
      return gap;
    }

    // The problem becomes that of w. Of its rows those remain that act or that the correction might close.
    void make_displacements(const SolvedContacts &s, const std::vector<double> &gap, const double penetration)
    {
      ContactProblem &problem = s.problem;
      for (std::size_t b = 0; b < s.v_new.size(); ++b)
        {
          BodyVelocity &w = problem.free_velocity[b];
          w.x -= s.v_new[b].x;
          w.y -= s.v_new[b].y;
          w.surface -= s.v_new[b].surface;
        }
      const auto is_far = [&](const int k) { return !(s.impulses[k].normal > 0 || gap[k] < 2 * penetration); };
      problem.order.erase(std::remove_if(problem.order.begin(), problem.order.end(), is_far), problem.order.end());
      for (const int k : problem.order)
        {
          problem.contacts[k].normal_term     = gap[k] / s.step;
          problem.contacts[k].tangential_term = 0;
        }
    }

    void move(State &state, const std::vector<BodyVelocity> &w, const double step)
    {
      Grains           &g = state.grains;
      const std::size_t n = g.size();
      for (std::size_t i = 0; i < n; ++i)
        if (const int platen = g.platen(i); platen >= 0)
          g.position[i] += step * Eigen::Vector2d(w[n + platen].x, w[n + platen].y);
        else if (!g.fixed[i])
          {
            g.position[i] += step * Eigen::Vector2d(w[i].x, w[i].y);
            g.rotation[i] += step * w[i].surface / g.radius[i];
          }
      for (std::size_t k = 0; k < state.walls.size(); ++k)
        state.walls[k].point += step * Eigen::Vector2d(w[n + k].x, w[n + k].y);
      if (PeriodicWidth *periodic = state.width(); periodic && periodic->moves())
        periodic->width += step * w[n + state.walls.size()].x;
      if (Lattice *lattice = state.lattice())
        {
          const Eigen::Vector3d strain = step * rate_of(w[n + 2]);
          lattice->vectors += (velocity_gradient(strain) * lattice->vectors).eval();
          lattice->strain += strain;
        }
    }
  } // namespace

  void correct_positions(State &state, const SolvedContacts &solved, const double enough, ThreadTeam &team)
  {
    constexpr int             sweeps      = 10;
    const std::vector<double> gap         = gaps_to_come(solved);
    const double              penetration = gap.empty() ? 0 : -*std::min_element(gap.begin(), gap.end());
    if (penetration <= enough)
      return;
    make_displacements(solved, gap, penetration);
    BatchedContacts batches(solved.problem, {}, {}, team.processes());
    batches.set_impulses(solved.impulses);
    batches.sweep(1., 1., sweeps, team); // over-relaxed sweeps oscillate and push grains apart
    batches.refresh_velocities();
    move(state, batches.velocities(), solved.step);
  }
} // namespace diptych::discrete
