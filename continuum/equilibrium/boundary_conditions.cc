// diptych: constraints and loads from platens and sides
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/equilibrium/boundary_conditions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include <deal.II/dofs/dof_tools.h>

#include "continuum/mesh/mesh.h"

namespace diptych::continuum
{
  using namespace dealii;

  namespace
  {
    constexpr double huge = std::numeric_limits<double>::max();

    std::vector<types::global_dof_index> component_dofs(const std::vector<Node> &nodes, const unsigned int component)
    {
      std::vector<types::global_dof_index> dofs;
      for (const auto &node : nodes)
        dofs.push_back(node.dofs[component]);
      return dofs;
    }
  } // namespace

  SideContact side_contact(const Discretisation             &mesh,
                           const std::vector<double>        &displacement,
                           const std::array<PlatenPlane, 2> &planes)
  {
    const double tolerance = 1e-9 * mesh.extent.y();
    SideContact  contact;
    for (const bool upper : {false, true})
      for (const unsigned int side : {left_side, right_side})
        for (const auto &node : mesh.boundary_nodes(side, displacement, [&](const Eigen::Vector2d &p) {
               return upper ? p.y() >= planes[1].now - tolerance : p.y() <= planes[0].now + tolerance;
             }))
          if (std::abs(node.initial.y() - planes[upper].initial) > tolerance) // otherwise it is an end of the platen
            contact[upper].push_back(node);
    return contact;
  }

  BoundaryConditions::BoundaryConditions(Discretisation    &mesh,
                                         const Loading     &loading,
                                         const PlatenGrip  &grip,
                                         const SideContact &side_contact)
      : loading(loading),
        is_rough(grip.rough),
        platen_nodes{mesh.boundary_nodes(lower_platen), mesh.boundary_nodes(upper_platen)}
  {
    for (const unsigned int platen : {0u, 1u})
      platen_nodes[platen].insert(platen_nodes[platen].end(), side_contact[platen].begin(), side_contact[platen].end());
    for (const unsigned int platen : {0u, 1u})
      drive_platen(platen, grip.rough);
    if (const auto *rigid = std::get_if<RigidSides>(&loading.lateral))
      add_rigid_sides(mesh, *rigid);
    if (grip.slides)
      find_sliding_nodes(mesh);
    if (const auto *periodic = std::get_if<PeriodicSides>(&loading.lateral))
      add_periodic_sides(mesh, *periodic, grip.rough);
    if (grip.holds_rotation)
      hold_rotations();
    if (!grip.rough && !grip.slides && !std::holds_alternative<RigidSides>(loading.lateral))
      pin_sideways();
    build(mesh);
  }

  std::vector<double> BoundaryConditions::platen_forces(const Discretisation &mesh, const std::vector<double> &nodal_forces) const
  {
    // A node that neither sticks to a platen nor slides along it with friction is held sideways by a side wall.
    std::set<types::global_dof_index> slides;
    for (const SlidingNode &node : sliding)
      slides.insert(node.tangential);
    std::vector<double> forces(nodal_forces.size(), 0.);
    for (const auto &platen : platen_nodes)
      for (const auto &node : platen)
        for (unsigned int c = 0; c < 2; ++c)
          if ((c == 1 || is_rough || slides.count(node.dofs[0]) > 0) && mesh.relevant.is_element(node.dofs[c]))
            forces[mesh.relevant.index_within_set(node.dofs[c])] = nodal_forces[mesh.relevant.index_within_set(node.dofs[c])];
    return forces;
  }

  bool BoundaryConditions::is_ruled(const types::global_dof_index dof) const
  {
    return std::binary_search(governed.begin(), governed.end(), dof);
  }

  void BoundaryConditions::add_rule(const Rule &rule)
  {
    rules.push_back(rule);
    governed.insert(std::upper_bound(governed.begin(), governed.end(), rule.dof), rule.dof);
  }

  void BoundaryConditions::move_together(const std::vector<types::global_dof_index> &dofs)
  {
    for (std::size_t k = 1; k < dofs.size(); ++k)
      add_rule({dofs[k], {{dofs[0], 1.}}});
    governed.insert(std::upper_bound(governed.begin(), governed.end(), dofs[0]), dofs[0]);
  }

  void BoundaryConditions::drive_platen(const unsigned int platen, const bool rough)
  {
    for (unsigned int c = rough ? 0 : 1; c < 2; ++c)
      {
        const Drive &drive = this->loading.platens[platen][c];
        const auto   dofs  = component_dofs(platen_nodes[platen], c);
        if (drive.is_force)
          {
            move_together(dofs);
            forced.emplace_back(dofs[0], &drive);
          }
        else
          for (const auto dof : dofs)
            add_rule({dof, {}, drive.value ? &drive.value : nullptr});
      }
  }

  // Where a platen and a wall meet, neither slides. A periodic side is a tie, not a wall.
  void BoundaryConditions::find_sliding_nodes(const Discretisation &mesh)
  {
    for (const unsigned int platen : {0u, 1u})
      for (const Node &node : platen_nodes[platen])
        {
          const auto &motion = loading.platens[platen][0].value;
          if (!is_ruled(node.dofs[0]))
            sliding.push_back({node.dofs[0], node.dofs[1], platen == 0 ? 1. : -1., motion ? &motion : nullptr});
        }
    if (std::holds_alternative<RigidSides>(loading.lateral))
      for (const unsigned int side : {left_side, right_side})
        for (const Node &node : mesh.boundary_nodes(side))
          if (!is_ruled(node.dofs[1]))
            sliding.push_back({node.dofs[1], node.dofs[0], side == left_side ? 1. : -1.});
  }

  void BoundaryConditions::hold_rotations()
  {
    for (const auto &nodes : platen_nodes)
      for (const auto &node : nodes)
        if (node.rotation != numbers::invalid_dof_index)
          add_rule({node.rotation, {}});
  }

  // A sample between smooth platens could slide as a rigid body: fixes the node of the lower platen nearest to its middle.
  void BoundaryConditions::pin_sideways()
  {
    double left = huge, right = -huge;
    for (const auto &node : platen_nodes[0])
      {
        left  = std::min(left, node.initial.x());
        right = std::max(right, node.initial.x());
      }
    const auto distance = [&](const Node &node) { return std::abs(node.initial.x() - (left + right) / 2); };
    const auto nearest  = std::min_element(platen_nodes[0].begin(), platen_nodes[0].end(),
                                           [&](const Node &a, const Node &b) { return distance(a) < distance(b); });
    add_rule({nearest->dofs[0], {}});
  }

  void BoundaryConditions::add_rigid_sides(const Discretisation &mesh, const RigidSides &sides)
  {
    const auto free_of_platens = [&](const unsigned int id) {
      auto dofs = component_dofs(mesh.boundary_nodes(id), 0);
      dofs.erase(std::remove_if(dofs.begin(), dofs.end(), [&](const auto dof) { return is_ruled(dof); }), dofs.end());
      return dofs;
    };
    for (const auto dof : free_of_platens(left_side))
      add_rule({dof, {}});
    const auto right = free_of_platens(right_side);
    if (sides.widening)
      {
        widening = sides.widening;
        for (const auto dof : right)
          add_rule({dof, {}, &widening});
      }
    else
      move_together(right);
  }

  // Right node = left node + change of the width. A free width is the distance of the first pair; all other pairs follow it.
  void BoundaryConditions::add_periodic_sides(const Discretisation &mesh, const PeriodicSides &sides, const bool rough)
  {
    auto       left = mesh.boundary_nodes(left_side), right = mesh.boundary_nodes(right_side);
    const auto by_height = [](const Node &a, const Node &b) { return a.initial.y() < b.initial.y(); };
    std::sort(left.begin(), left.end(), by_height);
    std::sort(right.begin(), right.end(), by_height);
    bool match = left.size() == right.size();
    for (std::size_t k = 0; match && k < left.size(); ++k)
      match = std::abs(left[k].initial.y() - right[k].initial.y()) < 1e-6 * mesh.extent.y();
    if (!match)
      throw std::invalid_argument("lateral = periodic: the left and right sides of the mesh do not match node by node");
    if (!sides.widening && rough)
      throw std::invalid_argument("lateral = periodic with a free width: rough platens cannot stretch; set platens = smooth");
    if (sides.widening)
      widening = [rate = *sides.widening](const double progress) { return rate * progress; };
    for (std::size_t k = 0; k < left.size(); ++k)
      if (right[k].rotation != numbers::invalid_dof_index && !is_ruled(right[k].rotation))
        add_rule({right[k].rotation, {{left[k].rotation, 1.}}});
    for (std::size_t k = 0; k < left.size(); ++k)
      for (unsigned int c = 0; c < 2; ++c)
        {
          const auto l = left[k].dofs[c], r = right[k].dofs[c];
          if (is_ruled(r) || (k == 0 && c == 0 && !sides.widening))
            continue;
          if (c == 0 && !sides.widening)
            add_rule({r, {{l, 1.}, {right[0].dofs[0], 1.}, {left[0].dofs[0], -1.}}});
          else
            add_rule({r, {{l, 1.}}, c == 0 ? &widening : nullptr});
        }
  }

  void BoundaryConditions::build(Discretisation &mesh)
  {
    std::vector<types::global_dof_index> masters;
    // On every process: a side node that later joins a tied platen must not change the numbering of existing vectors.
    for (const auto &rule : rules)
      for (const auto &[master, weight] : rule.masters)
        masters.push_back(master);
    mesh.add_relevant(masters);
    unresolved.reinit(mesh.relevant);
    DoFTools::make_hanging_node_constraints(mesh.dof_handler, unresolved);
    for (const auto &rule : rules)
      if (mesh.relevant.is_element(rule.dof))
        {
          unresolved.add_line(rule.dof);
          unresolved.add_entries(rule.dof, rule.masters);
        }
    homogeneous.copy_from(unresolved);
    homogeneous.close();
  }

  AffineConstraints<double> BoundaryConditions::increment(const double from, const double to) const
  {
    AffineConstraints<double> constraints;
    constraints.copy_from(unresolved);
    for (const auto &rule : rules)
      if (rule.value != nullptr && constraints.get_local_lines().is_element(rule.dof) && constraints.is_constrained(rule.dof))
        constraints.set_inhomogeneity(rule.dof, (*rule.value)(to) - (*rule.value)(from));
    constraints.close();
    return constraints;
  }

  std::vector<std::pair<types::global_dof_index, double>> BoundaryConditions::applied_forces(const double progress) const
  {
    std::vector<std::pair<types::global_dof_index, double>> forces;
    for (const auto &[dof, drive] : forced)
      forces.emplace_back(dof, drive->value ? drive->value(progress) : 0.);
    return forces;
  }
} // namespace diptych::continuum
