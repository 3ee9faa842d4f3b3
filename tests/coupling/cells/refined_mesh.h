// diptych: locally refined meshes for the tests of coupling/
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <map>
#include <utility>

#include "coupling/cells/mesh_cells.h"

namespace diptych::coupling::synthetic
{
  // columns x rows cells over a box. The cells whose centre satisfies `divided` are cut into four, and then every node moves. An
  // undivided cell beside a divided one has a hanging node; a displacement that is not linear moves this node off the chord.
  inline QuadMesh refined_mesh(const Eigen::Vector2d                                         &lower,
                               const Eigen::Vector2d                                         &upper,
                               const std::array<unsigned int, 2>                             &cells,
                               const std::function<bool(const Eigen::Vector2d &)>            &divided,
                               const std::function<Eigen::Vector2d(const Eigen::Vector2d &)> &displacement)
  {
    QuadMesh                                                      mesh;
    std::vector<Eigen::Vector2d>                                  initial;
    std::map<std::pair<unsigned int, unsigned int>, unsigned int> number;
    const auto place = [&](const unsigned int column, const unsigned int row) { // in half cells
      return Eigen::Vector2d(lower.x() + (upper.x() - lower.x()) * column / (2 * cells[0]),
                             lower.y() + (upper.y() - lower.y()) * row / (2 * cells[1]));
    };
    const auto node = [&](const unsigned int column, const unsigned int row) {
      const auto [entry, is_new] = number.try_emplace({column, row}, initial.size());
      if (is_new)
        initial.push_back(place(column, row));
      return entry->second;
    };
    const auto add = [&](const unsigned int c, const unsigned int r, const unsigned int size) {
      mesh.cell.push_back({{node(c, r), node(c + size, r), node(c + size, r + size), node(c, r + size)}});
    };
    for (unsigned int r = 0; r < 2 * cells[1]; r += 2)
      for (unsigned int c = 0; c < 2 * cells[0]; c += 2)
        if (divided(place(c + 1, r + 1)))
          for (const unsigned int k : {0u, 1u, 2u, 3u})
            add(c + k % 2, r + k / 2, 1);
        else
          add(c, r, 2);
    for (const Eigen::Vector2d &x : initial)
      mesh.node.push_back(x + displacement(x));
    triangulate(mesh, initial);
    return mesh;
  }
} // namespace diptych::coupling::synthetic
