// diptych: fits order of convergence and limit to results at several sizes
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/studies/convergence_order.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace diptych::coupling
{
  namespace
  {
    constexpr double least_order = 0.25, largest_order = 6, order_step = 0.01, largest_rest = 0.05;

    struct Line
    {
      ConvergenceFit fit;
      double         squares = std::numeric_limits<double>::infinity(); // sum of squared residuals
    };

    // Limit and coefficient for a given order: a straight line over h^order.
    Line line_at(const double order, const std::vector<double> &h, const std::vector<double> &values)
    {
      const double n = double(h.size());
      double       x = 0, y = 0, xx = 0, xy = 0;
      for (std::size_t k = 0; k < h.size(); ++k)
        x += std::pow(h[k], order) / n, y += values[k] / n;
      for (std::size_t k = 0; k < h.size(); ++k)
        {
          const double dx = std::pow(h[k], order) - x;
          xx += dx * dx, xy += dx * (values[k] - y);
        }
      Line line{{y - xy / xx * x, xy / xx, order}, 0};
      for (std::size_t k = 0; k < h.size(); ++k)
        {
          const double left = values[k] - line.fit.limit - line.fit.coefficient * std::pow(h[k], order);
          line.squares += left * left;
        }
      return line;
    }
  } // namespace

  std::optional<ConvergenceFit> fit_convergence(const std::vector<double> &h, const std::vector<double> &values)
  {
    const auto [least, largest] = std::minmax_element(values.begin(), values.end());
    if (std::set<double>(h.begin(), h.end()).size() < 3 || !(*largest > *least))
      return std::nullopt;
    // Scaled by the largest h, so that powers of small numbers lose no digits.
    const double        unit = *std::max_element(h.begin(), h.end());
    std::vector<double> scaled;
    for (const double one : h)
      scaled.push_back(one / unit);
    Line best;
    for (int k = 0; least_order + k * order_step <= largest_order + 1e-9; ++k)
      if (const Line line = line_at(least_order + k * order_step, scaled, values); line.squares < best.squares)
        best = line;
    if (best.fit.order < least_order + order_step / 2 || best.fit.order > largest_order - order_step / 2)
      return std::nullopt;
    if (std::sqrt(best.squares / double(h.size())) > largest_rest * (*largest - *least))
      return std::nullopt;
    best.fit.coefficient /= std::pow(unit, best.fit.order);
    return best.fit;
  }
} // namespace diptych::coupling
