// diptych: outline of the grain sample between its platens
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/bodies/outline.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace diptych::discrete
{
  namespace
  {
    // Outermost surface on lines y = bottom + k dy; sign = -1 for the left side, +1 for the right one. The first and the last
    // line are platens. A disc within a hundredth of a diameter of a line (dy is a tenth) counts as touching it.
    std::vector<double> raw_envelope(const Grains &g, const double bottom, const double dy, const int n, const int sign)
    {
      const double        touch = 0.1 * dy;
      std::vector<double> edge(n, -std::numeric_limits<double>::infinity());
      for (std::size_t i = 0; i < g.size(); ++i)
        {
          const Eigen::Vector2d &x = g.position[i];
          const double           r = g.radius[i];
          // The clamps keep a grain far away from overflowing the conversion to int.
          const int first = int(std::clamp(std::ceil((x.y() - r - touch - bottom) / dy), 0., double(n)));
          const int last  = int(std::clamp(std::floor((x.y() + r + touch - bottom) / dy), -1., n - 1.));
          for (int k = first; k <= last; ++k)
            if (sign * x.x() + r > edge[k]) // skips the square root for the discs inside, which are nearly all
              {
                const double a = bottom + k * dy - x.y();
                edge[k]        = std::max(edge[k], sign * x.x() + std::sqrt(std::max(0., r * r - a * a)));
              }
        }
      // A line that meets no disc takes the value of the line below, or of the line above at the bottom.
      for (int k = 1; k < n; ++k)
        if (std::isinf(edge[k]))
          edge[k] = edge[k - 1];
      for (int k = n - 2; k >= 0; --k)
        if (std::isinf(edge[k]))
          edge[k] = edge[k + 1];
      for (double &x : edge)
        x *= sign;
      return edge;
    }

    // Normalised weights at -reach .. reach, cut at four standard deviations.
    std::vector<double> gauss_weights(const double standard_deviation_in_samples)
    {
      const int           reach = int(std::ceil(4 * standard_deviation_in_samples));
      std::vector<double> weight(2 * reach + 1);
      double              sum = 0;
      for (int a = -reach; a <= reach; ++a)
        sum += weight[a + reach] = std::exp(-0.5 * a * a / (standard_deviation_in_samples * standard_deviation_in_samples));
      for (double &w : weight)
        w /= sum;
      return weight;
    }

    double smoothed(const std::vector<double> &x, const std::vector<double> &weight, const int k)
    {
      const int n = int(x.size()), reach = int(weight.size()) / 2;
      double    y = 0;
      for (int a = -reach; a <= reach; ++a)
        y += weight[a + reach] * x[std::clamp(k + a, 0, n - 1)];
      return y;
    }

    std::vector<Eigen::Vector2d> side(const State &state, const double mean_diameter, const int sign)
    {
      const double bottom = state.walls[0].point.y(), height = state.walls[1].point.y() - bottom;
      // If the height exceeds ten times the sum of all diameters, no column of grains can span it: coarser lines suffice.
      const double              most = std::max(1e4, 100. * double(state.grains.size()));
      const int                 n    = std::max(2, int(std::lround(std::min(most, height / (0.1 * mean_diameter)))) + 1);
      const double              dy   = height / (n - 1);
      const std::vector<double> x = raw_envelope(state.grains, bottom, dy, n, sign), weight = gauss_weights(mean_diameter / dy);

      const int n_points = std::max(2, int(std::lround(std::min(0.05 * most, height / (2 * mean_diameter)))) + 1);
      std::vector<Eigen::Vector2d> points;
      for (int p = 0; p < n_points; ++p)
        {
          const int k = int(std::lround(double(p) * (n - 1) / (n_points - 1)));
          points.emplace_back(smoothed(x, weight, k), bottom + k * dy);
        }
      points.back().y() = state.walls[1].point.y();
      return points;
    }
  } // namespace

  Outline make_outline(const State &state, const double mean_diameter)
  {
    if (const Lattice *lattice = state.lattice())
      {
        const Eigen::Vector2d a1 = lattice->vectors.col(0), a2 = lattice->vectors.col(1);
        Eigen::Vector2d       corner = -0.5 * (a1 + a2);
        for (const Eigen::Vector2d &x : state.grains.position)
          corner += x / double(state.grains.size());
        return {{corner, corner + a2}, {corner + a1, corner + a1 + a2}};
      }
    const double bottom = state.walls[0].point.y(), top = state.walls[1].point.y();
    const auto   upright = [&](const double x) { return std::vector<Eigen::Vector2d>{{x, bottom}, {x, top}}; };
    if (state.walls.size() >= 4)
      return {upright(state.walls[2].point.x()), upright(state.walls[3].point.x())};
    if (const PeriodicWidth *periodic = state.width())
      {
        double mean = 0;
        for (const Eigen::Vector2d &x : state.grains.position)
          mean += x.x() / double(state.grains.size());
        return {upright(mean - 0.5 * periodic->width), upright(mean + 0.5 * periodic->width)};
      }
    return {side(state, mean_diameter, -1), side(state, mean_diameter, +1)};
  }

  double outline_area(const Outline &outline)
  {
    std::vector<Eigen::Vector2d> polygon = outline.right;
    polygon.insert(polygon.end(), outline.left.rbegin(), outline.left.rend());
    double twice = 0;
    for (std::size_t k = 0; k < polygon.size(); ++k)
      {
        const Eigen::Vector2d &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
        twice += a.x() * b.y() - a.y() * b.x();
      }
    return 0.5 * twice;
  }

  double outline_area(const Outline &outline, const double low, const double high)
  {
    const auto below = [&](const std::vector<Eigen::Vector2d> &side) { // integral of x dy
      double sum = 0;
      for (std::size_t k = 1; k < side.size(); ++k)
        {
          const Eigen::Vector2d &a = side[k - 1], &b = side[k];
          const double from = std::clamp(a.y(), low, high), to = std::clamp(b.y(), low, high), middle = 0.5 * (from + to);
          if (from != to)
            sum += (to - from) * (a.x() + (middle - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
        }
      return sum;
    };
    return below(outline.right) - below(outline.left);
  }
} // namespace diptych::discrete
