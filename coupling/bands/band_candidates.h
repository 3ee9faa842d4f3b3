// diptych: starting points of band fits, from scans over lines and pairs of lines
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "coupling/bands/band_fit.h"

namespace diptych::coupling
{
  // Means over square blocks of the given size [mean diameters]; they are fine enough for scans.
  BandData block_means(const BandData &data, double size);

  // True if two lines differ by at least the angle [radians] or the separation of their offsets [mean diameters].
  bool distinct(const BandShape &a, const BandShape &b, double angle, double separation);

  // A scan like a Radon transform: tanh profiles along every line of every angle (4 degrees apart) at three half widths. Each is
  // fitted to the blocks together with the affine background.
  class LineScan
  {
  public:
    LineScan(const BandData &blocks, const BandFitOptions &sample);

    // The lines that explain most beside the known bands and differ from one another, best first.
    std::vector<BandShape> best_lines(const std::vector<BandShape> &known, std::size_t n_best) const;

    // The pair of lines that together explain most, or empty. It is needed if neither line of a crossing pair is the best single
    // one.
    std::vector<BandShape> best_pair() const;

  private:
    Eigen::VectorXd affine_free_profile(const BandShape &shape) const;

    Eigen::VectorXd        root_weight; // a factor of every row of affine, profiles and data
    Eigen::MatrixXd        position;    // centres of the blocks [mean diameters]
    Eigen::MatrixXd        affine;      // orthonormal basis of the background
    std::vector<BandShape> lines;
    Eigen::MatrixXd        profiles; // one column per line, with the affine background removed
    Eigen::MatrixXd        data;     // u_x, u_y
    double                 smallest_square;
  };
} // namespace diptych::coupling
