// diptych: 95 % intervals from blocks of the sample drawn with replacement
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "coupling/statistics/interval.h"

namespace diptych::coupling
{
  // Neighbouring grains share force chains, so whole blocks are drawn, not grains (Kuensch 1989). What correlates over more
  // than a block is not seen: then the intervals are too narrow.
  struct BootstrapOptions
  {
    double        block     = 5;   // smallest side of a block [length]
    int           resamples = 400; // fewer than 40: no intervals
    std::uint64_t seed      = 1;
  };

  // Fewer blocks than this tell no interval.
  constexpr int minimum_blocks = 4;

  // Equal rectangles over the bounding box of a polygon in axes turned by angle_deg, their sides the smallest that are at
  // least `block` and a whole part of the box (the box's own side where that is shorter).
  struct Tiles
  {
    Eigen::Vector2d origin, along; // corner of the box, unit vector of the columns
    Eigen::Vector2d side;          // [length]
    int             columns = 1, rows = 1;

    int count() const { return columns * rows; }
    int tile(const Eigen::Vector2d &point) const; // 0 .. count() - 1; a point outside belongs to the nearest
  };
  // Throws std::invalid_argument without a polygon, for a block that is not positive, or for more than 1e8 tiles.
  Tiles tiles_over(const std::vector<Eigen::Vector2d> &polygon, double angle_deg, double block);

  // How often each of n blocks is drawn: one row a resample, each row's sum is n. Empty for fewer than minimum_blocks blocks or
  // 40 resamples. The same for the same seed, everywhere.
  std::vector<std::vector<int>> resampled_blocks(int n, const BootstrapOptions &options);

  // By what deviations of a resampled statistic are stretched: sqrt(n/(n-1)) t/z. The mean of n blocks drawn with replacement
  // scatters by (n-1)/n of the unbiased variance, and its quantiles are those of a normal distribution (z = 1.96) where n - 1
  // degrees of freedom call for Student's t: so stretched, the interval of a mean is Student's. NaN for n < minimum_blocks.
  double small_sample_factor(int n);

  // By what deviations are stretched besides where neighbouring blocks are correlated, >= 1. influence: what each block adds to
  // the statistic's deviation (its components in any unit; they sum to about 0 over the blocks), place: column and row of each.
  // The variance of a sum of blocks is sum c_bb + sum over b != b' c_bb', c = influence_b . influence_b'; the second sum is taken
  // over blocks that touch, each pair corrected for the common mean (-s^2/n), and the root of the ratio held within 1 and 2.
  double neighbour_factor(const std::vector<Eigen::Vector3d> &influence, const std::vector<Eigen::Vector2i> &place);

  // value + the 2.5 and 97.5 % quantiles of the deviations (resampled minus value, already stretched). NaN deviations (a
  // resample that has no such statistic) are left out; if more than a tenth are, or there are none, the ends are NaN.
  Interval interval_from(double value, const std::vector<double> &deviations);

  // Quantile with linear interpolation between order statistics (Hyndman and Fan 1996, type 7). NaN for no values.
  double quantile(std::vector<double> values, double share);
} // namespace diptych::coupling
