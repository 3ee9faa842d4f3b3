// diptych: a hexagonal lattice of discs in equilibrium under a uniform stress
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Core>

#include "coupling/probes/grain_network.h"

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
  // forces each disc away from the lattice's rim is in equilibrium. force(direction, row of the lower disc).
  template <class Force> GrainNetwork hexagonal_network(const int columns, const int rows, const Force &force)
  {
    GrainNetwork network;
    const auto   number = [columns](const int row, const int column) { return row * columns + column; };
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column)
        {
          network.position.emplace_back(column + 0.5 * (row % 2), row * std::sqrt(0.75));
          network.radius.push_back(0.5);
        }
    network.moment.assign(network.position.size(), Eigen::Matrix2d::Zero());
    const auto join = [&](const int i, const int j, const double size) {
      const Eigen::Vector2d normal = (network.position[i] - network.position[j]).normalized();
      network.forces.push_back({i, j, 0.5 * (network.position[i] + network.position[j]), normal, size * normal});
      for (const int grain : {i, j}) // each grain has half a branch: f (x) n / 2
        network.moment[grain] += 0.5 * size * normal * normal.transpose();
    };
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column)
        {
          if (column + 1 < columns)
            join(number(row, column), number(row, column + 1), force(0, row));
          if (row + 1 == rows)
            continue;
          if (const int right = column + row % 2; right < columns)
            join(number(row, column), number(row + 1, right), force(1, row));
          if (const int left = column + row % 2 - 1; left >= 0)
            join(number(row, column), number(row + 1, left), force(2, row));
        }
    network.contacts = network.forces;
    return network;
  }

  inline GrainNetwork hexagonal_network(const int columns, const int rows, const Eigen::Matrix2d &stress)
  {
    const auto f = lattice_forces(stress);
    return hexagonal_network(columns, rows, [&](const int direction, int) { return f[direction]; });
  }
} // namespace diptych::coupling::synthetic
