// diptych: least squares fit of tanh bands on an affine background by variable projection
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

namespace diptych::coupling
{
  // Scaled data: positions from the sample's centre in mean diameters, displacements in platen increments.
  struct BandData
  {
    std::vector<Eigen::Vector2d> x, u;
    std::vector<double>          w; // > 0
  };

  // The nonlinear parameters of one band: line along (cos, sin)(angle), normal n = (-sin, cos)(angle).
  struct BandShape
  {
    double angle      = 0; // radians
    double offset     = 0; // along n [mean diameters]
    double half_width = 1; // delta [mean diameters]

    double profile(const Eigen::Vector2d &x) const; // tanh((n.x - offset) / half_width)
  };

  struct BandFitOptions
  {
    double width = 0, height = 0;      // of the sample [mean diameters]
    double smallest_half_width = 0.5;  // [mean diameters]
    double huber_threshold     = 2;    // scales
    double scale_floor         = 0.01; // [platen increments]
  };

  // A wider tanh can hardly be told from the affine background: a quarter of the sample's extent along the band's normal.
  double largest_half_width(const BandFitOptions &options, double angle);

  struct BandFit
  {
    std::vector<BandShape> shape;
    Eigen::Matrix<double, Eigen::Dynamic, 2>
           coefficient;         // rows: constant, d/dx, d/dy, then half the jump of each band; columns: u_x, u_y
    double robust_variance = 0; // per component, with Huber's weights
    double mean_misfit     = 0; // weighted mean of |u - fit|
    int    iterations      = 0; // passes over the data
    bool   converged       = false;

    Eigen::Vector2d at(const Eigen::Vector2d &x) const;
  };

  // Minimises sum w rho(|u - c - G x - sum_b a_b tanh((n_b.x - o_b)/delta_b)|), rho of Huber, from the given shapes (none:
  // affine).
  [[nodiscard]] BandFit fit_bands(const BandData &data, const std::vector<BandShape> &start, const BandFitOptions &options);
} // namespace diptych::coupling
