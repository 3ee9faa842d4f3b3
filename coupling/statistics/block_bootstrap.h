// diptych: 95 % intervals from blocks of the sample drawn with replacement
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "coupling/statistics/interval.h"

namespace diptych::coupling
{
  // Neighbouring grains share force chains, so whole blocks are drawn, not grains (Kuensch 1989). Correlations over more than a
  // block are not captured, and the intervals are then too narrow.
  struct BootstrapOptions
  {
    double        block     = 5;   // smallest side of a block [length]
    int           resamples = 400; // fewer than 40: no intervals
    std::uint64_t seed      = 1;
  };

  // With fewer blocks there is no interval.
  constexpr int minimum_blocks = 4;

  // Equal rectangles over the bounding box of a polygon in axes turned by angle_deg. The number of rectangles along each side is
  // the largest for which they are at least `block` long. If the box is shorter than `block`, there is one.
  struct Tiles
  {
    Eigen::Vector2d origin, along; // corner of the box, unit vector along the rows
    Eigen::Vector2d side;          // [length]
    int             columns = 1, rows = 1;

    int count() const { return columns * rows; }
    int tile(const Eigen::Vector2d &point) const; // 0 .. count() - 1; a point outside belongs to the nearest tile
  };
  // Throws std::invalid_argument without a polygon, for a block that is not positive, or for more than 1e8 tiles.
  Tiles tiles_over(const std::vector<Eigen::Vector2d> &polygon, double angle_deg, double block);

  // The number of times that each of n blocks is drawn: one row per resample, with the sum n. Empty for fewer than minimum_blocks
  // blocks or 40 resamples. The same seed gives the same rows on every machine.
  std::vector<std::vector<int>> resampled_blocks(int n, const BootstrapOptions &options);

  // Factor that widens the deviations of a resampled statistic: sqrt(n/(n-1)) t/z. Here t is Student's for n - 1 degrees of
  // freedom, z = 1.96. The mean of n blocks drawn with replacement has (n-1)/n of the unbiased variance. Its quantiles are
  // normal (z) and not Student's (t). With this factor the interval of a mean is Student's interval. NaN for n <
  // minimum_blocks.
  double small_sample_factor(int n);

  // A second factor for the deviations, >= 1, if neighbouring blocks are correlated. influence: the contribution of each block to
  // the statistic's deviation (components in any unit; they add up to about 0 over the blocks). `place`: column and row of each
  // block. With c_bb' = influence_b . influence_b' and n blocks:
  //   V0 = sum c_bb, the variance of independent blocks;
  //   V = V0 + 2 sum over touching pairs (c_bb' + s^2/n), s^2 = V0/(n-1); s^2/n removes the bias from the common mean;
  //   factor = sqrt(V/V0), limited to 1..2.
  double neighbour_factor(const std::vector<Eigen::Vector3d> &influence, const std::vector<Eigen::Vector2i> &place);

  // value + the 2.5 and 97.5 % quantiles of the deviations (resampled minus value, already widened). Deviations that are NaN are
  // left out, because the statistic has no value there. If more than a tenth are NaN, or there are none at all, the ends are NaN.
  Interval interval_from(double value, const std::vector<double> &deviations);

  // Quantile with linear interpolation between order statistics (Hyndman and Fan 1996, type 7). NaN without values.
  double quantile(std::vector<double> values, double share);
} // namespace diptych::coupling
