// diptych: a hexagonal lattice of discs in equilibrium under a uniform stress
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Core>

#include "coupling/probes/grain_network.h"
#include "tests/common.h"

namespace diptych::coupling::synthetic
{
  // Normal forces at the contacts at 0, 60 and 120 degrees for a symmetric stress S on discs of diameter 1. Each disc has one
  // contact in each direction e_k and the area sqrt(3)/2, so S sqrt(3)/2 = sum f_k e_k (x) e_k.
  inline std::array<double, 3> lattice_forces(const Eigen::Matrix2d &stress)
  {
    const Eigen::Matrix2d s = std::sqrt(0.75) * stress;
    return {
      {s(0, 0) - s(1, 1) / 3, 2. / 3 * s(1, 1) + 2 / std::sqrt(3.) * s(0, 1), 2. / 3 * s(1, 1) - 2 / std::sqrt(3.) * s(0, 1)}};
  }

  // Rows along x from (0, 0) on, every second one moved by 1/2, with discs of diameter 1. All contacts carry force. With equal
  // forces each disc away from the lattice's rim is in equilibrium. force(direction, row of the lower disc). The sides of a
  // periodic lattice touch each other.
  template <class Force>
  GrainNetwork hexagonal_network(const int columns, const int rows, const Force &force, const bool is_periodic = false)
  {
    GrainNetwork network;
    for (int k = 0; k < rows * columns; ++k)
      network.position.emplace_back(k % columns + 0.5 * (k / columns % 2), k / columns * std::sqrt(0.75));
    network.radius.assign(rows * columns, 0.5);
    network.moment.assign(rows * columns, Eigen::Matrix2d::Zero());
    const auto join = [&](const int i, const int row, const int column, const double size) {
      if (row == rows || (!is_periodic && (column < 0 || column == columns)))
        return;
      const int             j      = row * columns + (column + columns) % columns;
      const Eigen::Vector2d apart  = network.position[i] - network.position[j];
      const double          shift  = is_periodic ? columns * std::round(apart.x() / columns) : 0;
      const Eigen::Vector2d normal = (apart - Eigen::Vector2d(shift, 0)).normalized();
      network.forces.push_back({i, j, network.position[i] - 0.5 * normal, normal, size * normal, shift});
      for (const int grain : {i, j}) // each grain has half a branch: f (x) n / 2
        network.moment[grain] += 0.5 * size * normal * normal.transpose();
    };
    for (int i = 0; i < rows * columns; ++i)
      {
        const int row = i / columns, right = i % columns + row % 2;
        join(i, row, i % columns + 1, force(0, row));
        join(i, row + 1, right, force(1, row));
        join(i, row + 1, right - 1, force(2, row));
      }
    network.contacts = network.forces;
    return network;
  }

  inline GrainNetwork hexagonal_network(const int columns, const int rows, const Eigen::Matrix2d &stress)
  {
    const auto f = lattice_forces(stress);
    return hexagonal_network(columns, rows, [&](const int direction, int) { return f[direction]; });
  }

  inline Eigen::Matrix2d oblique_stress()
  {
    return (Eigen::Matrix2d() << 1, 0.3, 0.3, 2).finished();
  }

  // With periodic sides and unit forces. Each grain of area sqrt(3)/2 has three contacts with sum n (x) n = 3/2 1. Therefore
  // sigma = sqrt(3) 1, and the solid fraction is pi / (2 sqrt 3) = 0.9069.
  inline GrainNetwork periodic_lattice(const int columns, const int rows)
  {
    return hexagonal_network(
      columns, rows, [](int, int) { return 1.; }, true);
  }
} // namespace diptych::coupling::synthetic
