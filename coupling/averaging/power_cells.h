// diptych: power diagram (Laguerre tessellation) of discs
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "coupling/cells/polygon.h"

namespace diptych::coupling
{
  // A convex cell with counter-clockwise corners; empty if other discs leave the disc no area. beyond[k]: the disc on the other
  // side of the edge corner[k] - corner[k + 1], or -1 for the box.
  struct PowerCell
  {
    std::vector<Eigen::Vector2d> corner; // [length]
    std::vector<int>             beyond;
  };

  // Points x of the box with |x - x_i|^2 - r_i^2 least for disc i form its cell. Returns the first n_cells cells; the cells of
  // all discs fill the box. Cell i is clipped by the radical axes of the discs around it, ring by ring, until no further disc can
  // reach it. The axis of disc j is at (D^2 + r_i^2 - r_j^2) / (2 D), D the distance of the centres. Among discs with the same
  // centre the largest counts; among equal discs the first. Throws std::invalid_argument if sizes do not match.
  std::vector<PowerCell> power_cells(const std::vector<Eigen::Vector2d> &position,
                                     const std::vector<double>          &radius,
                                     std::size_t                         n_cells,
                                     const Eigen::Vector2d              &lower,
                                     const Eigen::Vector2d              &upper);

  // Area that a convex polygon shares with a triangle, both counter-clockwise. `corners`: scratch space, overwritten.
  double shared_area(const std::vector<Eigen::Vector2d>   &convex,
                     const std::array<Eigen::Vector2d, 3> &triangle,
                     std::vector<Eigen::Vector2d>         &corners);
} // namespace diptych::coupling
