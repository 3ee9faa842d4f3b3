// diptych: 95 % intervals from blocks of the sample drawn with replacement
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/statistics/block_bootstrap.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "coupling/statistics/student.h"

namespace diptych::coupling
{
  namespace
  {
    constexpr int fewest_resamples = 40; // with fewer, the 2.5 % quantile is an extreme value
  }                                      // namespace

  int Tiles::tile(const Eigen::Vector2d &point) const
  {
    const Eigen::Vector2d x      = point - origin;
    const Eigen::Vector2d across = {-along.y(), along.x()};
    const int             column = std::clamp(static_cast<int>(std::floor(x.dot(along) / side.x())), 0, columns - 1);
    const int             row    = std::clamp(static_cast<int>(std::floor(x.dot(across) / side.y())), 0, rows - 1);
    return row * columns + column;
  }

  Tiles tiles_over(const std::vector<Eigen::Vector2d> &polygon, const double angle_deg, const double block)
  {
    if (polygon.empty() || !(block > 0))
      throw std::invalid_argument("blocks need a polygon, and a side above 0");
    const double          angle = angle_deg * M_PI / 180;
    const Eigen::Vector2d along(std::cos(angle), std::sin(angle)), across(-along.y(), along.x());
    Eigen::Array2d        low = Eigen::Array2d::Constant(INFINITY), high = -low;
    for (const Eigen::Vector2d &x : polygon)
      {
        const Eigen::Array2d local(x.dot(along), x.dot(across));
        low  = low.min(local);
        high = high.max(local);
      }

    constexpr double rounding = 1e-9; // so that a box of exactly four blocks gets four
    constexpr double most     = 1e8;
    if (const Eigen::Array2d blocks = 1 + (high - low) / block; !(blocks.prod() <= most))
      throw std::invalid_argument("a polygon would have " + std::to_string(blocks.prod()) + " blocks; at most 1e8 are possible");
    const auto parts = [&](const double length) { return std::max(1, int(length / block + rounding)); };
    Tiles      tiles;
    tiles.origin  = low[0] * along + low[1] * across;
    tiles.along   = along;
    tiles.columns = parts(high[0] - low[0]);
    tiles.rows    = parts(high[1] - low[1]);
    tiles.side    = {(high[0] - low[0]) / tiles.columns, (high[1] - low[1]) / tiles.rows};
    return tiles;
  }

  std::vector<std::vector<int>> resampled_blocks(const int n, const BootstrapOptions &options)
  {
    if (n < minimum_blocks || options.resamples < fewest_resamples)
      return {};
    std::mt19937_64               random(options.seed);
    std::vector<std::vector<int>> drawn(options.resamples, std::vector<int>(n, 0));
    for (std::vector<int> &row : drawn)
      for (int k = 0; k < n; ++k)
        ++row[static_cast<int>((random() >> 11) * 0x1p-53 * n)];
    return drawn;
  }

  double small_sample_factor(const int n)
  {
    if (n < minimum_blocks)
      return NAN;
    return std::sqrt(n / (n - 1.)) * student_quantile(0.975, n - 1) / normal_quantile;
  }

  double neighbour_factor(const std::vector<Eigen::Vector3d> &influence, const std::vector<Eigen::Vector2i> &place)
  {
    const std::size_t n       = influence.size();
    double            squares = 0, products = 0;
    int               pairs = 0;
    for (std::size_t a = 0; a < n; ++a)
      {
        squares += influence[a].squaredNorm();
        for (std::size_t b = a + 1; b < n; ++b)
          if ((place[a] - place[b]).cwiseAbs().maxCoeff() == 1)
            {
              products += influence[a].dot(influence[b]);
              ++pairs;
            }
      }
    if (n < 2 || !(squares > 0))
      return 1;
    return std::sqrt(std::clamp(1 + 2 * (products / squares + pairs / (n * (n - 1.))), 1., 4.));
  }

  Interval interval_from(const double value, const std::vector<double> &deviations)
  {
    std::vector<double> known;
    for (const double deviation : deviations)
      if (std::isfinite(deviation))
        known.push_back(deviation);
    if (known.empty() || known.size() < 0.9 * deviations.size())
      return {value, NAN, NAN};
    return {value, value + quantile(known, 0.025), value + quantile(known, 0.975)};
  }

  double quantile(std::vector<double> values, const double share)
  {
    if (values.empty())
      return NAN;
    std::sort(values.begin(), values.end());
    const double      place = share * (values.size() - 1);
    const std::size_t below = std::min(static_cast<std::size_t>(place), values.size() - 1);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    return values[below] + (place - below) * (values[above] - values[below]);
  }
} // namespace diptych::coupling
