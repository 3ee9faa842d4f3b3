// diptych: friction of the sample along platens and rigid side walls
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/equilibrium/wall_friction.h"

#include <cmath>

namespace diptych::continuum
{
  void WallFriction::begin_step(const FrictionLaw &law, const std::vector<SlidingNode> &nodes, const double from, const double to)
  {
    this->law   = law;
    this->nodes = &nodes;
    this->from  = from;
    this->to    = to;
    scale       = law.friction * law.slip_length * std::abs(to - from) + law.stick_slip;
  }

  // visit(node, index of its tangential dof among the relevant ones, normal force, displacement of the wall)
  template <class Visit>
  void WallFriction::each_pressed_node(const Discretisation &mesh, const std::vector<double> &reaction, Visit &&visit) const
  {
    for (const SlidingNode &node : *nodes)
      if (mesh.relevant.is_element(node.tangential))
        if (const double normal = node.inwards * reaction[mesh.relevant.index_within_set(node.normal)]; normal > 0)
          visit(node, unsigned(mesh.relevant.index_within_set(node.tangential)), normal,
                node.wall != nullptr ? (*node.wall)(to) - (*node.wall)(from) : 0.);
  }

  void WallFriction::add_force(const Discretisation      &mesh,
                               const std::vector<double> &increment,
                               const std::vector<double> &reaction,
                               std::vector<double>       &force)
  {
    by_normal_reaction.assign(increment.size(), 0.);
    by_slip.clear();
    dissipated = 0;
    each_pressed_node(mesh, reaction, [&](const SlidingNode &node, const unsigned int t, const double normal, const double wall) {
      const double slip     = increment[t] - wall;
      const double ratio    = law.friction * std::tanh(slip / scale);
      by_normal_reaction[t] = node.inwards * ratio;
      if (!mesh.owned.is_element(node.tangential))
        return;
      force[t] += ratio * normal;
      dissipated += ratio * normal * slip;
      const double elastic = law.friction * normal / scale;
      by_slip.push_back({node.tangential, t, elastic * (1 - std::pow(ratio / law.friction, 2)),
                         slip != 0 ? ratio * normal / slip : elastic, wall});
    });
  }

  void WallFriction::stick(const Discretisation &mesh, const std::vector<double> &reaction)
  {
    by_normal_reaction.clear();
    by_slip.clear();
    each_pressed_node(mesh, reaction, [&](const SlidingNode &node, const unsigned int t, const double normal, const double wall) {
      if (mesh.owned.is_element(node.tangential))
        by_slip.push_back({node.tangential, t, normal * law.friction / scale, normal * law.friction / scale, wall});
    });
  }

  void WallFriction::add_resistance(const std::vector<double> &increment, std::vector<double> &force) const
  {
    for (const Stiffness &one : by_slip)
      force[one.local] += one.tangent * (increment[one.local] - one.wall);
  }
} // namespace diptych::continuum
