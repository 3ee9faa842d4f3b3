// diptych: displacement increments at points, and the strain increment around any point
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "continuum/snapshot.h"
#include "discrete/snapshot.h"

namespace diptych::coupling
{
  // Displacement increments of grains or of nodes between two instants, at the later positions. One entry a point.
  struct DisplacementField
  {
    std::vector<Eigen::Vector2d> position;  // [length]
    std::vector<Eigen::Vector2d> increment; // [length]
    std::vector<double>          weight;    // area the point stands for; 0: ignore
  };

  // Grains weigh their disc's area; rattlers of either instant weigh nothing, but where at the earlier one nothing touches yet
  // (a table of grains, loaded as it stands) the later one decides. Throws std::invalid_argument when the numbers of
  // grains differ. The mesh of the continuum may have been refined between the instants (node_transfer.h).
  DisplacementField displacement_field(const discrete::Snapshot &from, const discrete::Snapshot &to);
  DisplacementField displacement_field(const continuum::Snapshot &from, const continuum::Snapshot &to);

  // Radius of the affine fits that every shear strain increment is made with [length].
  inline double strain_radius(const double mean_diameter)
  {
    return 2.5 * mean_diameter;
  }

  // Gradient of the displacement increment around each sample point, G_kl = d u_k / d x_l: affine least squares over the points
  // of the field within the radius. NaN where fewer than 4 points of positive weight are found or they lie nearly on a line.
  std::vector<Eigen::Matrix2d> displacement_gradient(const DisplacementField            &field,
                                                     const std::vector<Eigen::Vector2d> &sample_points,
                                                     double                              radius);

  // eps_1 - eps_2 >= 0 of the symmetric displacement gradient, as above.
  std::vector<double> shear_strain_increment(const DisplacementField            &field,
                                             const std::vector<Eigen::Vector2d> &sample_points,
                                             double                              radius);
} // namespace diptych::coupling
