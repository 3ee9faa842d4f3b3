// diptych: constraints and loads from platens and sides
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <utility>
#include <vector>

#include <deal.II/lac/affine_constraints.h>

#include "continuum/elements/discretisation.h"
#include "continuum/loading.h"

namespace diptych::continuum
{
  struct PlatenGrip
  {
    bool rough          = true;  // both displacement components follow the platen; otherwise only the vertical one
    bool slides         = false; // friction acts on nodes that slide along a platen or a rigid side wall
    bool holds_rotation = false; // Cosserat rotations on the platen are zero
  };

  // Nodes of free sides that have reached the level of a platen. Platens are wider than the sample: material squeezed out
  // beside a platen rolls onto its plane and moves with it from then on.
  using SideContact = std::array<std::vector<Node>, 2>; // lower, upper platen
  struct PlatenPlane
  {
    double initial = 0, now = 0; // y [length]
  };
  SideContact side_contact(const Discretisation             &mesh,
                           const std::vector<double>        &displacement,
                           const std::array<PlatenPlane, 2> &planes);

  // A node that slides along a platen or a rigid side wall.
  struct SlidingNode
  {
    dealii::types::global_dof_index      tangential, normal; // dofs of displacement
    double                               inwards = 1;        // sign of the inward normal on its axis
    const std::function<double(double)> *wall    = nullptr;  // tangential displacement of the wall; nullptr: at rest
  };

  // Constraints on displacement and rotation. A platen or rigid wall prescribes displacement components of its nodes. If it
  // moves freely under a force, its nodes are tied to the first of them, which carries the force. Where platen and side meet,
  // the condition of the platen applies.
  class BoundaryConditions
  {
  public:
    // Adds the dofs of other processes that ties need to `mesh`. Throws std::invalid_argument for periodic sides that do not
    // match, and for a free width between rough platens.
    BoundaryConditions(Discretisation    &mesh,
                       const Loading     &loading,
                       const PlatenGrip  &grip,
                       const SideContact &side_contact = {});
    BoundaryConditions(const BoundaryConditions &)            = delete; // rules point to functions of this object
    BoundaryConditions &operator=(const BoundaryConditions &) = delete;

    // Constraints of a correction, including hanging nodes. Prescribed components are zero.
    const dealii::AffineConstraints<double> &correction() const { return homogeneous; }

    // Constraints of the displacement increment between two values of the progress.
    dealii::AffineConstraints<double> increment(double from, double to) const;

    // Forces on freely moving platens, as {dof, value}. Every process gets all of them.
    std::vector<std::pair<dealii::types::global_dof_index, double>> applied_forces(double progress) const;

    // Nodes of the lower and the upper platen on all processes, including those in side contact.
    const std::array<std::vector<Node>, 2> &platens() const { return platen_nodes; }

    // All nodes that slide along walls, on every process; empty without friction.
    const std::vector<SlidingNode> &sliding_nodes() const { return sliding; }

    // The part of the nodal forces that the platens exert. Both on the relevant dofs.
    std::vector<double> platen_forces(const Discretisation &mesh, const std::vector<double> &nodal_forces) const;

  private:
    // The displacement of a dof, or its excess over that of its master, as a function of the progress.
    struct Rule
    {
      dealii::types::global_dof_index                                 dof;
      std::vector<std::pair<dealii::types::global_dof_index, double>> masters;
      const std::function<double(double)>                            *value = nullptr; // empty: 0
    };

    void drive_platen(unsigned int platen, bool rough);
    void hold_rotations();
    void pin_sideways();
    void find_sliding_nodes(const Discretisation &mesh);
    void add_rigid_sides(const Discretisation &mesh, const RigidSides &sides);
    void add_periodic_sides(const Discretisation &mesh, const PeriodicSides &sides, bool rough);
    void move_together(const std::vector<dealii::types::global_dof_index> &dofs);
    void add_rule(const Rule &rule);
    bool is_ruled(dealii::types::global_dof_index dof) const;
    void build(Discretisation &mesh);

    Loading                                                                loading;
    bool                                                                   is_rough = true;
    std::function<double(double)>                                          widening; // of rigid or periodic sides
    std::array<std::vector<Node>, 2>                                       platen_nodes;
    std::vector<SlidingNode>                                               sliding;
    std::vector<Rule>                                                      rules;
    std::vector<dealii::types::global_dof_index>                           governed; // dofs with a rule or a tie, sorted
    std::vector<std::pair<dealii::types::global_dof_index, const Drive *>> forced;   // first dof of a tied platen
    // Closing a constraint object substitutes constrained masters. A hanging node beside a platen would then lose the platen's
    // motion.
    dealii::AffineConstraints<double> unresolved, homogeneous;
  };
} // namespace diptych::continuum
