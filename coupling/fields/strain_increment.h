// diptych: displacement increments at points, and the strain increment around a point
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "continuum/snapshot.h"
#include "discrete/snapshot.h"

namespace diptych::coupling
{
  // Displacement increments of grains or nodes between two instants, at the later positions. One entry per point.
  struct DisplacementField
  {
    std::vector<Eigen::Vector2d> position;  // [length]
    std::vector<Eigen::Vector2d> increment; // [length]
    std::vector<double>          weight;    // area that the point represents; 0: ignore the point
    std::vector<double>          rotation;  // increment of grains or of Cosserat nodes, anticlockwise [radians]; empty: none
  };

  // The weight of a grain is its disc's area. A grain that is a rattler at either instant has weight 0. If no grain has a contact
  // at the earlier instant, as in an imported table of grains, only the later instant counts. Throws std::invalid_argument if the
  // numbers of grains differ. The mesh of the continuum may be refined between the instants (node_transfer.h).
  DisplacementField displacement_field(const discrete::Snapshot &from, const discrete::Snapshot &to);
  DisplacementField displacement_field(const continuum::Snapshot &from, const continuum::Snapshot &to);

  // Radius of the affine fits behind all shear strain increments [length].
  inline double strain_radius(const double mean_diameter)
  {
    return 2.5 * mean_diameter;
  }

  // Gradient of the displacement increment around each sample point, G_kl = d u_k / d x_l. It is fitted by affine least squares
  // to the points of the field within the radius. NaN if fewer than 4 points of positive weight are found or they lie nearly on a
  // line.
  std::vector<Eigen::Matrix2d> displacement_gradient(const DisplacementField            &field,
                                                     const std::vector<Eigen::Vector2d> &sample_points,
                                                     double                              radius);

  // Mean of the rotations around each sample point, weighted by area x (radius^2 - distance^2). For points of even density the
  // affine fit above is the mean of the true gradient with these weights, so the difference of rotation and spin has no bias
  // where the gradient varies. NaN without points of positive weight or without rotations.
  std::vector<double> mean_rotation(const DisplacementField            &field,
                                    const std::vector<Eigen::Vector2d> &sample_points,
                                    double                              radius);

  // The affine fit at each point and what follows from it.
  struct LocalMotion
  {
    std::vector<Eigen::Matrix2d> gradient;          // displacement_gradient()
    std::vector<double>          shear;             // eps_1 - eps_2 of the strain increment
    std::vector<double>          spin;              // of the medium: half the curl, anticlockwise [radians]
    std::vector<double>          relative_rotation; // mean_rotation() - spin [radians]; NaN without rotations
  };
  LocalMotion local_motion(const DisplacementField &field, const std::vector<Eigen::Vector2d> &sample_points, double radius);

  // eps_1 - eps_2 >= 0 of the symmetric part of this gradient.
  std::vector<double> shear_strain_increment(const DisplacementField            &field,
                                             const std::vector<Eigen::Vector2d> &sample_points,
                                             double                              radius);
} // namespace diptych::coupling
