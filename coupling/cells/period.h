// diptych: repetition of a sample along x or along two lattice vectors
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <vector>

#include <Eigen/Core>
#include <Eigen/LU>

#include "coupling/cells/mesh_cells.h"
#include "discrete/snapshot.h"

namespace diptych::coupling
{
  // A sample repeats itself at whole numbers of its periods, the columns of `vectors` [length]: none, one along x or two.
  struct Period
  {
    Period(const double width = 0)
        : Period(Eigen::Matrix2d(Eigen::Vector2d(width, 0).asDiagonal()))
    {}
    explicit Period(const Eigen::Matrix2d &lattice)
        : vectors(lattice),
          inverse(both() ? Eigen::Matrix2d(lattice.inverse()) : Eigen::Matrix2d(Eigen::Matrix2d::Zero()))
    {}

    Eigen::Matrix2d vectors, inverse;

    bool any() const { return vectors(0, 0) != 0 || both(); }
    bool both() const { return !vectors.col(1).isZero(0); }

    // Coordinates of x along the periods; 0 where there is none.
    Eigen::Vector2d fractions(const Eigen::Vector2d &x) const
    {
      return both() ? Eigen::Vector2d(inverse * x) : Eigen::Vector2d(any() ? x.x() / vectors(0, 0) : 0., 0);
    }
    // The multiple of the periods that is nearest to x.
    Eigen::Vector2d nearest(const Eigen::Vector2d &x) const { return vectors * fractions(x).array().round().matrix(); }

    // Shifts of the copies that surround a sample: none, those to the left and right, or eight.
    std::vector<Eigen::Vector2d> neighbours() const;
    // All images of x in a box; x alone without a period.
    std::vector<Eigen::Vector2d> images_in(const Eigen::Vector2d &x,
                                           const Eigen::Vector2d &lower,
                                           const Eigen::Vector2d &upper) const;
    // Moves each place by whole periods to where its fractions, counted from `corner`, lie in [0, 1). Returns the moves.
    std::vector<Eigen::Vector2d> wrap(const Eigen::Vector2d &corner, std::vector<Eigen::Vector2d> &places) const;
  };

  Period period_of(const discrete::Snapshot &grains);

  // Contacts of grains that were moved by whole periods. If i and j move by different ones, another image of j touches i.
  void follow_grains(const std::vector<Eigen::Vector2d> &moves, std::vector<discrete::ContactForce> &contacts);

  // The mesh and its surrounding copies. Triangle t of copy k has the number k * n_triangles + t; copy 0 is the mesh itself. The
  // copies share no nodes.
  QuadMesh tiled(const QuadMesh &mesh, const Period &period);

  // For each node, the node that is the same in the periodic sample: that of the left or lower side, or itself. `near`: tolerance
  // [length].
  std::vector<unsigned int> same_nodes(const QuadMesh &mesh, const Period &period, double near);
} // namespace diptych::coupling
