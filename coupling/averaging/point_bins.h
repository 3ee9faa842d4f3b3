// diptych: points sorted into square bins
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Core>

namespace diptych::coupling
{
  // Deterministic order: bins row by row from below, points ascending in each.
  class PointBins
  {
  public:
    // bin_size > 0; no bins at all for no points.
    PointBins(const std::vector<Eigen::Vector2d> &position, const double bin_size)
        : size(bin_size)
    {
      if (position.empty())
        return;
      Eigen::Vector2d upper = origin = position.front();
      for (const Eigen::Vector2d &x : position)
        origin = origin.cwiseMin(x), upper = upper.cwiseMax(x);
      n_columns = 1 + int((upper.x() - origin.x()) / size);
      n_rows    = 1 + int((upper.y() - origin.y()) / size);
      begin.assign(std::size_t(n_columns) * n_rows + 1, 0);
      const auto bin = [this](const Eigen::Vector2d &x) {
        return std::size_t((x.y() - origin.y()) / size) * n_columns + std::size_t((x.x() - origin.x()) / size);
      };
      for (const Eigen::Vector2d &x : position)
        ++begin[bin(x) + 1];
      for (std::size_t b = 1; b < begin.size(); ++b)
        begin[b] += begin[b - 1];
      point.resize(position.size());
      std::vector<unsigned int> next(begin.begin(), begin.end() - 1);
      for (unsigned int i = 0; i < position.size(); ++i)
        point[next[bin(position[i])]++] = i;
    }

    double bin_size() const { return size; }

    // Points in the bins at a Chebyshev distance of `ring` bins from the bin of x. Returns false where the ring lies beyond all
    // bins. All points closer to x than (ring + 1) bin sizes are in the rings 0 .. ring + 1.
    template <class Action> bool for_each_in_ring(const Eigen::Vector2d &x, const int ring, Action &&action) const
    {
      const int row = int(std::floor((x.y() - origin.y()) / size)), column = int(std::floor((x.x() - origin.x()) / size));
      bool      any = false;
      for (int r = std::max(0, row - ring); r <= std::min(n_rows - 1, row + ring); ++r)
        {
          const int step = r == row - ring || r == row + ring ? 1 : 2 * ring; // whole rows at the ends, two bins between
          for (int c = column - ring; c <= column + ring; c += std::max(1, step))
            if (c >= 0 && c < n_columns)
              {
                any = true;
                for_each_in_bin(std::size_t(r) * n_columns + c, action);
              }
        }
      return any;
    }

    // Points in all bins that meet the square of half side `reach` around x.
    template <class Action> void for_each_near(const Eigen::Vector2d &x, const double reach, Action &&action) const
    {
      const auto at = [this](const double distance, const int n) {
        return int(std::clamp(std::floor(distance / size), -1., double(n)));
      };
      const Eigen::Vector2d d = x - origin;
      for (int r = std::max(0, at(d.y() - reach, n_rows)); r <= std::min(n_rows - 1, at(d.y() + reach, n_rows)); ++r)
        for (int c = std::max(0, at(d.x() - reach, n_columns)); c <= std::min(n_columns - 1, at(d.x() + reach, n_columns)); ++c)
          for_each_in_bin(std::size_t(r) * n_columns + c, action);
    }

  private:
    template <class Action> void for_each_in_bin(const std::size_t bin, Action &action) const
    {
      for (unsigned int k = begin[bin]; k < begin[bin + 1]; ++k)
        action(point[k]);
    }

    double                    size;
    Eigen::Vector2d           origin    = Eigen::Vector2d::Zero();
    int                       n_columns = 0, n_rows = 0;
    std::vector<unsigned int> begin, point;
  };
} // namespace diptych::coupling
