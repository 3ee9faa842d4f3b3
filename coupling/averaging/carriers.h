// diptych: the grain quantities to be distributed over cells, and their sums over cells
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <vector>

#include <Eigen/Core>

#include "discrete/snapshot.h"

namespace diptych::coupling
{
  using Columns = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  // The segment from a grain's centre to one of its contact points.
  struct HalfBranch
  {
    unsigned int    grain;
    Eigen::Vector2d vector; // [length]
  };

  // Extensive quantities (mass, momentum, moment, ...) and their places. A matrix without columns carries nothing.
  struct Carriers
  {
    std::vector<Eigen::Vector2d> position;          // of grain centres [length]
    std::vector<double>          radius;            // [length]
    double                       mean_diameter = 1; // unit of AveragingOptions::width [length]
    std::vector<HalfBranch>      half;

    Columns             of_grains; // n_grains x any
    Columns             uniform;   // n_halves x any, spread evenly along the half branch
    Columns             tapered;   // n_halves x any, densest at the centre, decreasing linearly to zero at the contact point
    std::vector<double> half_size; // n_halves: weight of a half branch in outside_share, >= 0; |f| x length for a force

    bool count_joined = false; // compute CellSums::joined
    // Compute CellSums::nodal_residual. The first four columns of `uniform` must be moments -force (x) vector.
    bool judge_nodes = false;
  };

  // Has n_cells rows and the columns of the carriers. With every method the sum over cells equals the sum over carriers to
  // round-off.
  struct CellSums
  {
    Columns of_grains, uniform, tapered;
    // Share of half_size that went to a boundary cell because its place is outside the mesh. The place is the piece of the branch
    // (segments), the centre (centroid) or the whole power cell (laguerre). It is a quadrature point beyond the kernel's reach
    // (kernel) or outside the mesh (projection).
    double outside_share = 0;
    // Only for segments with judge_nodes: residual of the nodal identity (README.md), also at the collar's nodes, over the
    // largest force. NaN if the mesh can have no collar, a half leaves it, or there is no force.
    double nodal_residual = NAN;
    // Number of equal grains that a mean over the cell joins: (sum of the shares of grains)^2 / sum of their squares. n_cells
    // entries, 0 for a cell without grains; empty if not wanted. The projection solves one system per cell for it.
    std::vector<double> joined;
  };

  // Calls action(grain, vector, force) for each half of a contact's branch. `vector` runs from the grain's centre to the contact
  // point and `force` acts on this grain. A platen has no half. Throws std::invalid_argument for a grain that does not exist.
  template <class Action>
  void for_each_half(const discrete::ContactForce &contact, const std::vector<Eigen::Vector2d> &position, Action &&action);

  // Half branches of the contacts that carry force, each with its moment -f (x) vector, where f acts on its grain. Row index =
  // force (columns xx, xy, yx, yy of `uniform`), positive in compression [pressure * length^2].
  Carriers moment_carriers(const std::vector<Eigen::Vector2d>        &position,
                           const std::vector<double>                 &radius,
                           const std::vector<discrete::ContactForce> &contacts);

  [[noreturn]] void refuse_contact(const discrete::ContactForce &contact);

  template <class Action>
  void for_each_half(const discrete::ContactForce &contact, const std::vector<Eigen::Vector2d> &position, Action &&action)
  {
    const int n = int(position.size());
    if (contact.i < 0 || contact.i >= n || contact.j < 0)
      refuse_contact(contact);
    action(unsigned(contact.i), Eigen::Vector2d(contact.point - position[contact.i]), contact.force);
    if (contact.j < n)
      action(unsigned(contact.j),
             Eigen::Vector2d(contact.point - position[contact.j] - Eigen::Vector2d(contact.shift, contact.shift_y)),
             Eigen::Vector2d(-contact.force));
  }
} // namespace diptych::coupling
