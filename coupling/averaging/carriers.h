// diptych: what of the grains is distributed over cells, and the sums there
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <vector>

#include <Eigen/Core>

#include "discrete/snapshot.h"

namespace diptych::coupling
{
  using Columns = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  // From the centre of its grain to a contact point of it.
  struct HalfBranch
  {
    unsigned int    grain;
    Eigen::Vector2d vector; // [length]
  };

  // Extensive quantities (mass, momentum, moment, ...) with where they sit; a matrix without columns carries nothing.
  struct Carriers
  {
    std::vector<Eigen::Vector2d> position;          // of grain centres [length]
    std::vector<double>          radius;            // [length]
    double                       mean_diameter = 1; // unit of AveragingOptions::width [length]
    std::vector<HalfBranch>      half;

    Columns             of_grains; // n_grains x any
    Columns             uniform;   // n_halves x any, spread evenly along the half branch
    Columns             tapered;   // n_halves x any, densest at the centre, falling linearly to zero at the contact point
    std::vector<double> half_size; // n_halves: what outside_share is counted in, >= 0; of a force |f| x length

    bool count_joined = false; // CellSums::joined is wanted
    // CellSums::nodal_residual is wanted: the first four columns of `uniform` are moments -force (x) vector.
    bool judge_nodes = false;
  };

  // n_cells rows, columns as in the carriers. The sum over cells is the sum over carriers to round-off, whatever the method.
  struct CellSums
  {
    Columns of_grains, uniform, tapered;
    // Share of half_size that was assigned to a boundary cell because its place is outside the mesh: the piece of the branch
    // (segments), the centre (centroid), the whole power cell (laguerre), a quadrature point beyond the kernel's reach
    // (kernel) or outside the mesh (projection).
    double outside_share = 0;
    // segments with judge_nodes: sum_K M_K grad N_a against the sum over halves of f (N_a(centre) - N_a(contact point)), what a
    // branch within the mesh telescopes to: largest difference at any node, collar included, / largest force. NaN where no
    // collar can be laid round the mesh, a half leaves it, or without forces.
    double nodal_residual = NAN;
    // n_cells, empty if not wanted: (sum of the shares of grains)^2 / sum of their squares, the number of equal grains that a
    // mean over the cell joins; 0 for a cell without grains. The projection needs one solution a cell for it.
    std::vector<double> joined;
  };

  // Calls action(grain, vector, force) for each half of the branch of a contact: vector from the grain's centre to the
  // contact point, force on that grain. A platen has no half. Throws std::invalid_argument for grains that do not exist.
  template <class Action>
  void for_each_half(const discrete::ContactForce &contact, const std::vector<Eigen::Vector2d> &position, Action &&action);

  // Half branches of the contacts that carry force, each with its moment -f (x) vector, f on its grain: row index = force
  // (columns xx, xy, yx, yy of `uniform`), positive in compression [pressure * length^2].
  Carriers moment_carriers(const std::vector<Eigen::Vector2d>        &position,
                           const std::vector<double>                 &radius,
                           const std::vector<discrete::ContactForce> &contacts);

  // ---- implementation

  [[noreturn]] void refuse_contact(const discrete::ContactForce &contact);

  template <class Action>
  void for_each_half(const discrete::ContactForce &contact, const std::vector<Eigen::Vector2d> &position, Action &&action)
  {
    const int n = int(position.size());
    if (contact.i < 0 || contact.i >= n || contact.j < 0)
      refuse_contact(contact);
    action(unsigned(contact.i), Eigen::Vector2d(contact.point - position[contact.i]), contact.force);
    if (contact.j < n)
      action(unsigned(contact.j), Eigen::Vector2d(contact.point - position[contact.j] - Eigen::Vector2d(contact.shift, 0)),
             Eigen::Vector2d(-contact.force));
  }
} // namespace diptych::coupling
