// diptych: least squares fit of tanh bands on an affine background by variable projection
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "coupling/bands/band_projection.h"

namespace diptych::coupling
{
  struct BandFitOptions
  {
    double width = 0, height = 0;      // size of the sample [mean diameters]
    double smallest_half_width = 0.5;  // [mean diameters]
    double huber_threshold     = 2;    // scales
    double scale_floor         = 0.01; // [platen increments]
  };

  // A quarter of the sample's extent along the band's normal. A wider tanh can hardly be distinguished from the affine
  // background.
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

  // Minimises sum w rho(|u - c - G x - sum_b a_b tanh((n_b.x - o_b)/delta_b)|), rho of Huber. The iteration begins with the given
  // shapes; without shapes the fit is affine.
  [[nodiscard]] BandFit fit_bands(const BandData &data, const std::vector<BandShape> &start, const BandFitOptions &options);

  // Plain least squares with the given weights, starting from a nearby fit. It ends when angles, offsets / half widths and log
  // half widths change by less than the tolerance. Robust variance and misfit remain those of the start.
  [[nodiscard]] BandFit refit_bands(const BandData       &data,
                                    const BandFit        &start,
                                    const BandFitOptions &options,
                                    double                tolerance = 1e-3);

  std::vector<double> huber_weights(const BandData &data, const BandFit &fit, const BandFitOptions &options);
} // namespace diptych::coupling
