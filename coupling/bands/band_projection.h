// diptych: tanh bands on an affine background, with the linear coefficients eliminated
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

  // The nonlinear parameters of one band: a line along (cos, sin)(angle) with normal n = (-sin, cos)(angle).
  struct BandShape
  {
    double angle      = 0; // radians
    double offset     = 0; // along n [mean diameters]
    double half_width = 1; // delta [mean diameters]

    double profile(const Eigen::Vector2d &x) const; // tanh((n.x - offset) / half_width)
  };

  // Minimum over the linear coefficients of S = sum w |u - c - G x - sum_b a_b tanh((n_b.x - o_b)/delta_b)|^2, with its
  // derivatives. The nonlinear parameters are angle, offset and log half width of each band in turn (variable projection, Golub &
  // Pereyra 1973).
  struct BandProjection
  {
    double                                   sum_of_squares = 0; // S
    double                                   data_squares   = 0; // sum w |u|^2
    Eigen::Matrix<double, Eigen::Dynamic, 2> coefficient;        // rows: constant, d/dx, d/dy, a of each band
    Eigen::VectorXd                          descent;            // -1/2 dS
    Eigen::MatrixXd                          gauss_newton;       // 1/2 d2S without the terms of the misfit: never negative
    Eigen::MatrixXd                          hessian;            // 1/2 d2S
  };

  // Projects at most two bands. For grains and for coarse laws the misfit is not noise. The Gauss-Newton form then converges
  // slowly (tens of steps), and the full second derivative in a few steps.
  BandProjection project_bands(const BandData &data, const std::vector<double> &weight, const std::vector<BandShape> &shape);
} // namespace diptych::coupling
