// diptych: what platens and sides ask of the unknowns, and with what they load them
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
  // How platens hold the sample.
  struct PlatenGrip
  {
    bool rough          = true;  // both components of the displacement follow the platen; else the vertical one
    bool holds_rotation = false; // Cosserat rotations on it vanish
  };

  // Nodes of free sides that have come level with a platen. Platens are wider than the sample: what is squeezed out beside one
  // rolls onto its plane and moves with it from then on. Else it would be extruded past the platen like paste.
  using SideContact = std::array<std::vector<Node>, 2>; // lower, upper platen
  struct PlatenPlane
  {
    double initial = 0, now = 0; // y [length]
  };
  SideContact side_contact(const Discretisation             &mesh,
                           const std::vector<double>        &displacement,
                           const std::array<PlatenPlane, 2> &planes);

  // Constraints on displacement and rotation. A platen or rigid wall prescribes components of its nodes, or ties them together
  // where it moves freely under a force, which then acts on the first of them. Between platen and side the platen's word counts.
  class BoundaryConditions
  {
  public:
    // Adds to `mesh` the dofs of other processes that ties need. Throws std::invalid_argument for a loading that the mesh or
    // its platens do not allow (periodic sides that do not match, a free width between rough platens).
    BoundaryConditions(Discretisation    &mesh,
                       const Loading     &loading,
                       const PlatenGrip  &grip,
                       const SideContact &side_contact = {});
    BoundaryConditions(const BoundaryConditions &)            = delete; // rules point to this object's functions
    BoundaryConditions &operator=(const BoundaryConditions &) = delete;

    // Constraints of a correction (prescribed components: zero), hanging nodes included.
    const dealii::AffineConstraints<double> &correction() const { return homogeneous; }

    // Constraints of the increment of displacement while the loading goes from one progress to another.
    dealii::AffineConstraints<double> increment(double from, double to) const;

    // Distance of the platens at a progress, where their vertical motion is prescribed; else `present`. [length]
    double height(double progress, double present) const;

    // Forces on platens that move freely, as {dof, value}. Each process gets all.
    std::vector<std::pair<dealii::types::global_dof_index, double>> applied_forces(double progress) const;

    // Nodes of the lower and of the upper platen, of all processes, those in side contact included.
    const std::array<std::vector<Node>, 2> &platens() const { return platen_nodes; }

  private:
    // The displacement of a dof, or its excess over its master's, as a function of the progress.
    struct Rule
    {
      dealii::types::global_dof_index                                 dof;
      std::vector<std::pair<dealii::types::global_dof_index, double>> masters;
      const std::function<double(double)>                            *value = nullptr; // none: 0
    };

    void drive_platen(unsigned int platen, bool rough);
    void hold_rotations();
    void pin_sideways();
    void add_rigid_sides(const Discretisation &mesh, const RigidSides &sides);
    void add_periodic_sides(const Discretisation &mesh, const PeriodicSides &sides, bool rough);
    void move_together(const std::vector<dealii::types::global_dof_index> &dofs);
    void add_rule(const Rule &rule);
    bool is_ruled(dealii::types::global_dof_index dof) const;
    void build(Discretisation &mesh);

    Loading                                                                loading;
    double                                                                 initial_height;
    std::function<double(double)>                                          widening; // of rigid or periodic sides
    std::array<std::vector<Node>, 2>                                       platen_nodes;
    std::vector<Rule>                                                      rules;
    std::vector<dealii::types::global_dof_index>                           governed; // dofs that rules or ties speak of, sorted
    std::vector<std::pair<dealii::types::global_dof_index, const Drive *>> forced;   // first dof of a tied platen
    // Closing substitutes masters that are constrained themselves: a hanging node beside a platen would forget that it moves.
    dealii::AffineConstraints<double> unresolved, homogeneous;
  };
} // namespace diptych::continuum
