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
    // Compute the residuals of CellSums. The columns of `uniform` and `tapered` must begin with those of moment_carriers().
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
    double nodal_residual  = NAN;
    double couple_residual = NAN; // residual of the nodal balance of moment, over largest force x longest half branch
    // Number of equal grains that a mean over the cell joins: (sum of the shares of grains)^2 / sum of their squares. n_cells
    // entries, 0 for a cell without grains; empty if not wanted. The projection solves one system per cell for it.
    std::vector<double> joined;
  };

  // Calls action(grain, vector, force, couple) for each half of a contact's branch. `vector` runs from the grain's centre to the
  // contact point; `force` and `couple` act on this grain. A platen has no half. Throws std::invalid_argument for a grain that
  // does not exist.
  template <class Action>
  void for_each_half(const discrete::ContactForce &contact, const std::vector<Eigen::Vector2d> &position, Action &&action);

  // Couple stress. The body beyond a point x of a branch exerts the couple c(x) = (x_c - x) x f + m about x on the grain's part
  // of the branch. Here x_c is the contact point, f and m are force and couple of the contact on the grain. The moment of the
  // couple is -integral of c(x) ds over the branch, ds from the centre to the contact point, with the sign of the stress
  // (compression):
  //   |K| mu_K = -sum_c integral over the branch in K of ((x_c - x) x f + m) ds          [pressure * length^2]
  // Its divergence balances the skew stress of the same branches and the couples of the grains about their centres, node by node
  // (README.md). The reference point is the point x itself, so the value does not depend on the origin. Summed over a contact it
  // is the couple stress of coarse graining at the grains' centres, -(c_i - c_j)/2 (x) branch with c_i the couple of the contact
  // about the centre of i (Goldhirsch, Granular Matter 12 (2010) 239). The couple stress of a finite volume about a point X also
  // contains the moment of the skew stress about X (Elias and Cusatis, arXiv 2412.12616); it equals the mean of mu for X at the
  // volume's centroid if the skew stress is uniform.
  //
  // Half branches of the contacts that carry force. Columns of `uniform`: the moments -f (x) vector, positive in compression, row
  // index = force (xx, xy, yx, yy), then -m vector (x, y). Columns of `tapered`: -1/2 (vector x f) vector, the other part of the
  // couple's moment.
  enum MomentColumn : Eigen::Index
  {
    couple_moment    = 4, // first of the two columns -m vector
    n_moment_columns = 6
  };
  Carriers moment_carriers(const std::vector<Eigen::Vector2d>        &position,
                           const std::vector<double>                 &radius,
                           const std::vector<discrete::ContactForce> &contacts);

  // The columns of one half branch, as above.
  Eigen::Matrix<double, 1, n_moment_columns> uniform_moments(const Eigen::Vector2d &vector,
                                                             const Eigen::Vector2d &force,
                                                             double                 couple);
  Eigen::RowVector2d                         tapered_couple(const Eigen::Vector2d &vector, const Eigen::Vector2d &force);

  // Moments of the couples of each grain's half branches, n_grains entries [pressure * length^2].
  std::vector<Eigen::Vector2d> couple_moments(const Carriers &moments);

  [[noreturn]] void refuse_contact(const discrete::ContactForce &contact);

  template <class Action>
  void for_each_half(const discrete::ContactForce &contact, const std::vector<Eigen::Vector2d> &position, Action &&action)
  {
    const int n = int(position.size());
    if (contact.i < 0 || contact.i >= n || contact.j < 0)
      refuse_contact(contact);
    action(unsigned(contact.i), Eigen::Vector2d(contact.point - position[contact.i]), contact.force, contact.acting_couple());
    if (contact.j < n)
      action(unsigned(contact.j),
             Eigen::Vector2d(contact.point - position[contact.j] - Eigen::Vector2d(contact.shift, contact.shift_y)),
             Eigen::Vector2d(-contact.force), -contact.acting_couple());
  }
} // namespace diptych::coupling
