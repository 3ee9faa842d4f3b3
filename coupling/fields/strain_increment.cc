// diptych: displacement increments at points, and the strain increment around any point
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/fields/strain_increment.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <Eigen/LU>

#include "coupling/fields/node_transfer.h"

namespace diptych::coupling
{
  namespace
  {
    // Points sorted into square bins of the search radius: all neighbours lie in the 3x3 bins around a point.
    struct PointBins
    {
      PointBins(const std::vector<Eigen::Vector2d> &position, const std::vector<double> &weight, const double size)
          : bin_size(size)
      {
        Eigen::Vector2d lower = Eigen::Vector2d::Constant(INFINITY), upper = -lower;
        for (const auto &x : position)
          {
            lower = lower.cwiseMin(x);
            upper = upper.cwiseMax(x);
          }
        origin    = lower;
        n_columns = 1 + static_cast<int>((upper.x() - lower.x()) / bin_size);
        n_rows    = 1 + static_cast<int>((upper.y() - lower.y()) / bin_size);
        begin.assign(static_cast<std::size_t>(n_columns) * n_rows + 1, 0);
        std::vector<int> bin(position.size());
        for (std::size_t i = 0; i < position.size(); ++i)
          {
            bin[i] = static_cast<int>((position[i].y() - origin.y()) / bin_size) * n_columns +
                     static_cast<int>((position[i].x() - origin.x()) / bin_size);
            if (weight[i] > 0)
              ++begin[bin[i] + 1];
          }
        for (std::size_t b = 1; b < begin.size(); ++b)
          begin[b] += begin[b - 1];
        point.resize(begin.back());
        std::vector<unsigned int> next(begin.begin(), begin.end() - 1);
        for (unsigned int i = 0; i < position.size(); ++i)
          if (weight[i] > 0)
            point[next[bin[i]]++] = i;
      }

      template <class Action> void for_each_near(const Eigen::Vector2d &x, const Action &action) const
      {
        const double column = std::floor((x.x() - origin.x()) / bin_size);
        const double row    = std::floor((x.y() - origin.y()) / bin_size);
        if (!(column >= -1 && row >= -1 && column <= n_columns && row <= n_rows))
          return;
        for (int r = std::max(0, int(row) - 1); r < std::min(n_rows, int(row) + 2); ++r)
          for (int c = std::max(0, int(column) - 1); c < std::min(n_columns, int(column) + 2); ++c)
            for (unsigned int k = begin[r * n_columns + c]; k < begin[r * n_columns + c + 1]; ++k)
              action(point[k]);
      }

      Eigen::Vector2d           origin;
      double                    bin_size;
      int                       n_columns, n_rows;
      std::vector<unsigned int> begin, point;
    };

    // G minimises sum w |u - c - G (x - x_0)|^2: with means taken off, G = (sum w u' (x) x') (sum w x' (x) x')^-1.
    Eigen::Matrix2d gradient_around(const DisplacementField &field,
                                    const PointBins         &bins,
                                    const Eigen::Vector2d   &centre,
                                    const double             radius)
    {
      double          sum_w = 0;
      int             n     = 0;
      Eigen::Vector2d sum_x = Eigen::Vector2d::Zero(), sum_u = Eigen::Vector2d::Zero();
      const auto      for_each_inside = [&](const auto &action) {
        bins.for_each_near(centre, [&](const unsigned int i) {
          if ((field.position[i] - centre).squaredNorm() <= radius * radius)
            action(i);
        });
      };
      for_each_inside([&](const unsigned int i) {
        ++n;
        sum_w += field.weight[i];
        sum_x += field.weight[i] * (field.position[i] - centre);
        sum_u += field.weight[i] * field.increment[i];
      });
      if (n < 4)
        return Eigen::Matrix2d::Constant(NAN);

      const Eigen::Vector2d mean_x = centre + sum_x / sum_w, mean_u = sum_u / sum_w;
      Eigen::Matrix2d       xx = Eigen::Matrix2d::Zero(), ux = Eigen::Matrix2d::Zero();
      for_each_inside([&](const unsigned int i) {
        const Eigen::Vector2d x = field.position[i] - mean_x;
        xx += field.weight[i] * x * x.transpose();
        ux += field.weight[i] * (field.increment[i] - mean_u) * x.transpose();
      });
      // 4 det / trace^2 = 1 for an isotropic cloud, 0 for points on a line
      if (!(4 * xx.determinant() > 1e-3 * xx.trace() * xx.trace()))
        return Eigen::Matrix2d::Constant(NAN);
      return ux * xx.inverse();
    }

    DisplacementField increments(const discrete::Snapshot &from, const discrete::Snapshot &to)
    {
      if (from.displacement.size() != to.displacement.size())
        throw std::invalid_argument("displacement increments need the same grains at both instants");
      DisplacementField field;
      field.position = to.position;
      field.increment.resize(to.displacement.size());
      for (std::size_t i = 0; i < to.displacement.size(); ++i)
        field.increment[i] = to.displacement[i] - from.displacement[i];
      return field;
    }
  } // namespace

  DisplacementField displacement_field(const discrete::Snapshot &from, const discrete::Snapshot &to)
  {
    DisplacementField field   = increments(from, to);
    const auto        rattles = [](const discrete::Snapshot &s, const std::size_t i) {
      return i < s.rattler.size() && s.rattler[i] != 0;
    };
    field.weight.resize(field.position.size());
    for (std::size_t i = 0; i < field.weight.size(); ++i)
      field.weight[i] = rattles(from, i) || rattles(to, i) ? 0 : M_PI * to.radius[i] * to.radius[i];
    return field;
  }

  DisplacementField displacement_field(const continuum::Snapshot &from, const continuum::Snapshot &to)
  {
    DisplacementField field;
    field.position                             = to.position;
    field.weight                               = to.weight;
    const std::vector<Eigen::Vector2d> earlier = displacement_at_nodes_of(from, to);
    for (std::size_t k = 0; k < earlier.size(); ++k)
      field.increment.emplace_back(to.displacement[k] - earlier[k]);
    return field;
  }

  std::vector<Eigen::Matrix2d> displacement_gradient(const DisplacementField            &field,
                                                     const std::vector<Eigen::Vector2d> &sample_points,
                                                     const double                        radius)
  {
    if (!(radius > 0))
      throw std::invalid_argument("the radius of the affine fits must be positive");
    if (field.increment.size() != field.position.size() || field.weight.size() != field.position.size())
      throw std::invalid_argument("a displacement field needs one increment and one weight a point");
    if (field.position.empty())
      return std::vector<Eigen::Matrix2d>(sample_points.size(), Eigen::Matrix2d::Constant(NAN));

    const PointBins              bins(field.position, field.weight, radius);
    std::vector<Eigen::Matrix2d> gradient(sample_points.size());
    for (std::size_t k = 0; k < sample_points.size(); ++k)
      gradient[k] = gradient_around(field, bins, sample_points[k], radius);
    return gradient;
  }

  // eps_1 - eps_2 = sqrt((e_xx - e_yy)^2 + (2 e_xy)^2)
  std::vector<double> shear_strain_increment(const DisplacementField            &field,
                                             const std::vector<Eigen::Vector2d> &sample_points,
                                             const double                        radius)
  {
    std::vector<double> shear;
    shear.reserve(sample_points.size());
    for (const auto &g : displacement_gradient(field, sample_points, radius))
      shear.push_back(std::hypot(g(0, 0) - g(1, 1), g(0, 1) + g(1, 0)));
    return shear;
  }
} // namespace diptych::coupling
