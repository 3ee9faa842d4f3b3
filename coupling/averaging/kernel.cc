// diptych: smoothing kernels in two dimensions, and their integrals over cells
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/averaging/kernel.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace diptych::coupling
{
  namespace
  {
    constexpr double gauss_reach = 4, edge_over_width = 1.5;

    struct Point
    {
      double       x, y, area;
      unsigned int cell;
    };

    // n^2 equal parts with three points each, at the barycentric coordinates (2/3, 1/6, 1/6).
    void add_points(const std::array<Eigen::Vector2d, 3> &corner,
                    const int                             n,
                    const unsigned int                    cell,
                    std::vector<Point>                   &points)
    {
      const Eigen::Vector2d u = (corner[1] - corner[0]) / n, v = (corner[2] - corner[0]) / n;
      const double          third = (u.x() * v.y() - u.y() * v.x()) / 6;
      const auto            part  = [&](const Eigen::Vector2d &middle, const double sign) {
        // The vectors from the middle of a part to its corners are -(u+v)/3, (2u-v)/3 and (2v-u)/3. Inverted parts have the
        // opposite signs.
        for (const Eigen::Vector2d &d : {Eigen::Vector2d(-u - v), Eigen::Vector2d(2 * u - v), Eigen::Vector2d(2 * v - u)})
          {
            const Eigen::Vector2d x = middle + sign / 6 * d;
            points.push_back({x.x(), x.y(), third, cell});
          }
      };
      for (int a = 0; a < n; ++a)
        for (int b = 0; a + b < n; ++b)
          {
            part(corner[0] + (a + 1. / 3) * u + (b + 1. / 3) * v, 1);
            if (a + b + 1 < n)
              part(corner[0] + (a + 2. / 3) * u + (b + 2. / 3) * v, -1);
          }
    }

    std::vector<Point> quadrature_points(const QuadMesh &mesh, const double longest_edge)
    {
      std::vector<Point> points;
      for (const CellTriangle &triangle : mesh.triangle)
        {
          const std::array<Eigen::Vector2d, 3> corner = {
            {mesh.node[triangle.node[0]], mesh.node[triangle.node[1]], mesh.node[triangle.node[2]]}};
          double edge = 0;
          for (unsigned int k = 0; k < 3; ++k)
            edge = std::max(edge, (corner[(k + 1) % 3] - corner[k]).norm());
          add_points(corner, std::max(1, int(std::ceil(edge / longest_edge - 1e-9))), triangle.cell, points);
        }
      return points;
    }
  } // namespace

  Kernel::Kernel(const KernelShape shape, const double standard_deviation)
      : is_gauss(shape == KernelShape::gauss),
        deviation(standard_deviation)
  {
    if (!(deviation > 0))
      throw std::invalid_argument("a kernel needs a positive standard deviation");
    radius = is_gauss ? gauss_reach * deviation : std::sqrt(56. / 5) * deviation;
    peak   = is_gauss ? 1 / (2 * M_PI * deviation * deviation * (1 - std::exp(-0.5 * gauss_reach * gauss_reach)))
                      : 5 / (M_PI * radius * radius);
  }

  Eigen::ArrayXd Kernel::operator()(const Eigen::ArrayXd &squared_distance) const
  {
    const auto in_reach = squared_distance < radius * radius;
    if (is_gauss)
      return in_reach.select(peak * (squared_distance * (-0.5 / (deviation * deviation))).exp(), 0.);
    const Eigen::ArrayXd q = (squared_distance.sqrt() / radius).min(1.);
    return peak * (1 + 3 * q) * (1 - q).cube();
  }

  double Kernel::operator()(const double squared_distance) const
  {
    if (squared_distance >= radius * radius)
      return 0;
    if (is_gauss)
      return peak * std::exp(-0.5 * squared_distance / (deviation * deviation));
    const double q = std::sqrt(squared_distance) / radius;
    return peak * (1 + 3 * q) * (1 - q) * (1 - q) * (1 - q);
  }

  KernelQuadrature::KernelQuadrature(const TargetCells &target, const Kernel &kernel)
      : kernel(kernel),
        period(target.period),
        lower(target.lower),
        upper(target.upper),
        bins(target.lower, target.upper, kernel.reach() / 6),
        sum_of_cell(target.n_cells(), 0.)
  {
    const std::vector<Point> points = quadrature_points(target.mesh, edge_over_width * kernel.width());
    bins.sort(points.size(), [&](const unsigned int p, const auto &into) { into(bins.bin_of({points[p].x, points[p].y})); });
    x_.resize(Eigen::Index(points.size()));
    y_ = area_ = x_;
    cell_.resize(points.size());
    Eigen::Index k = 0;
    for (const unsigned int p : bins.sorted())
      {
        x_[k]    = points[p].x;
        y_[k]    = points[p].y;
        area_[k] = points[p].area;
        cell_[k] = points[p].cell;
        ++k;
      }
  }

  void KernelQuadrature::weights(const Eigen::Vector2d &x, Weights &result)
  {
    result.cell.clear();
    result.value.clear();
    result.sum                   = 0;
    const Eigen::Vector2d margin = Eigen::Vector2d::Constant(kernel.reach());
    for (const Eigen::Vector2d &image : period.images_in(x, lower - margin, upper + margin))
      add_image(image, result);
    for (const unsigned int c : result.cell)
      {
        result.value.push_back(sum_of_cell[c]);
        result.sum += sum_of_cell[c];
        sum_of_cell[c] = 0;
      }
  }

  void KernelQuadrature::add_image(const Eigen::Vector2d &x, Weights &result)
  {
    const double          reach  = kernel.reach();
    const Eigen::Vector2d square = Eigen::Vector2d::Constant(reach);
    const BinRange        all    = bins.range(x - square, x + square);
    for (int row = all.row_begin; row < all.row_end; ++row)
      {
        // Half the chord of the kernel's circle at that edge of this row of bins which is nearest to x.
        const double          low  = bins.row_low(row);
        const double          away = std::max({0., low - x.y(), x.y() - low - bins.bin_size()});
        const Eigen::Vector2d half(std::sqrt(std::max(0., reach * reach - away * away)), 0);
        const BinRange        chord = bins.range(x - half, x + half);
        if (chord.column_begin >= chord.column_end)
          continue;
        const unsigned int begin = bins.begins(bins.number(row, chord.column_begin)),
                           n     = bins.begins(bins.number(row, chord.column_end)) - begin;

        const Eigen::ArrayXd value = kernel((x_.segment(begin, n) - x.x()).square() + (y_.segment(begin, n) - x.y()).square()) *
                                     area_.segment(begin, n);
        for (unsigned int k = 0; k < n; ++k)
          if (value[k] > 0)
            {
              double &sum = sum_of_cell[cell_[begin + k]];
              if (sum == 0)
                result.cell.push_back(cell_[begin + k]);
              sum += value[k];
            }
      }
  }

  SegmentRule segment_rule(const double length, const double width)
  {
    const int    n = std::max(1, int(std::ceil(length / width)));
    const double d = 0.5 / std::sqrt(3.);
    SegmentRule  rule;
    for (int k = 0; k < n; ++k)
      for (const double at : {0.5 - d, 0.5 + d})
        {
          rule.t.push_back((k + at) / n);
          rule.weight.push_back(0.5 / n);
        }
    return rule;
  }
} // namespace diptych::coupling
