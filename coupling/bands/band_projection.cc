// diptych: tanh bands on an affine background, with the linear coefficients eliminated
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/bands/band_projection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include <Eigen/Cholesky>

namespace diptych::coupling
{
  namespace
  {
    using Coefficients = Eigen::Matrix<double, Eigen::Dynamic, 2>;

    // tanh with an absolute error of 1e-16, which suffices for a fit, at a quarter of std::tanh's cost.
    double fast_tanh(const double z)
    {
      return 1 - 2 / (std::exp(2 * z) + 1);
    }

    // One band at one point: z = (n.x - o)/delta, t = s.x/delta, profile = tanh z.
    struct PointInBand
    {
      double z, t, profile;
    };

    // K is fixed at compile time because the loops over all points take most of the time.
    template <int K> class Loops
    {
    public:
      Loops(const BandData &points, const std::vector<double> &weights, const std::vector<BandShape> &shapes)
          : data(points),
            weight(weights),
            shape(shapes),
            place(points.x.size())
      {
        for (int b = 0; b < K; ++b)
          {
            const Eigen::Vector2d along(std::cos(shape[b].angle), std::sin(shape[b].angle)), normal(-along.y(), along.x());
            for (std::size_t i = 0; i < data.x.size(); ++i)
              {
                const double z = (normal.dot(data.x[i]) - shape[b].offset) / shape[b].half_width;
                place[i][b]    = {z, along.dot(data.x[i]) / shape[b].half_width, fast_tanh(z)};
              }
          }
      }

      // Columns: affine (3), profiles (K), their derivatives (3 K), data (2). One weighted Gram matrix holds most of the terms of
      // a step. It is summed over a few points at a time, each column contiguous, so that the sums stay in registers.
      Eigen::MatrixXd gram_matrix() const
      {
        constexpr int                      n = 5 + 4 * K, n_points = 16;
        Eigen::MatrixXd                    gram = Eigen::MatrixXd::Zero(n, n);
        Eigen::Matrix<double, n_points, n> rows = Eigen::Matrix<double, n_points, n>::Zero();
        Eigen::Matrix<double, n_points, 1> weights;
        for (std::size_t first = 0; first < data.x.size(); first += n_points)
          {
            weights.setZero();
            for (std::size_t i = first; i < std::min(first + n_points, data.x.size()); ++i)
              {
                fill_row(i, rows.row(i - first));
                weights[i - first] = weight[i];
              }
            for (int c = 0; c < n; ++c)
              {
                const Eigen::Matrix<double, n_points, 1> weighted = rows.col(c).cwiseProduct(weights);
                for (int r = c; r < n; ++r)
                  gram(r, c) += rows.col(r).dot(weighted);
              }
          }
        gram.template triangularView<Eigen::StrictlyUpper>() = gram.transpose();
        return gram;
      }

      // sum w (misfit . a_b) times the second derivatives of the profile of band b, one 3 x 3 block per band.
      std::array<Eigen::Matrix3d, K> misfit_curvature(const Coefficients &coefficient) const
      {
        std::array<Eigen::Matrix3d, K> sum;
        for (auto &block : sum)
          block.setZero();
        for (std::size_t i = 0; i < data.x.size(); ++i)
          {
            Eigen::Vector2d misfit = data.u[i];
            misfit -= coefficient.row(0).transpose();
            misfit -= data.x[i].x() * coefficient.row(1).transpose() + data.x[i].y() * coefficient.row(2).transpose();
            for (int b = 0; b < K; ++b)
              misfit -= place[i][b].profile * coefficient.row(3 + b).transpose();
            for (int b = 0; b < K; ++b)
              {
                const PointInBand &p      = place[i][b];
                const double       factor = weight[i] * coefficient.row(3 + b).dot(misfit) * (1 - p.profile * p.profile);
                const double       bend = -2 * p.profile * factor, inverse = 1 / shape[b].half_width;
                // First derivatives of z: -t by angle, -1/delta by offset, -z by log delta. The second by angle is -(z +
                // o/delta), and so on.
                sum[b](0, 0) += bend * p.t * p.t - factor * (p.z + shape[b].offset * inverse);
                sum[b](1, 0) += bend * p.t * inverse;
                sum[b](2, 0) += bend * p.t * p.z + factor * p.t;
                sum[b](1, 1) += bend * inverse * inverse;
                sum[b](2, 1) += (bend * p.z + factor) * inverse;
                sum[b](2, 2) += bend * p.z * p.z + factor * p.z;
              }
          }
        return sum;
      }

    private:
      template <class Row> void fill_row(const std::size_t i, Row &&row) const
      {
        row.template head<3>() << 1, data.x[i].x(), data.x[i].y();
        for (int b = 0; b < K; ++b)
          {
            const PointInBand &p     = place[i][b];
            const double       slope = 1 - p.profile * p.profile;
            row[3 + b]               = p.profile;
            row.template segment<3>(3 + K + 3 * b) << -slope * p.t, -slope / shape[b].half_width, -slope * p.z;
          }
        row.template tail<2>() = data.u[i].transpose();
      }

      const BandData                         &data;
      const std::vector<double>              &weight;
      const std::vector<BandShape>           &shape;
      std::vector<std::array<PointInBand, K>> place;
    };

    // Parameter k belongs to band k / 3; m is a component of the displacement.
    template <int K>
    BandProjection projection(const BandData &data, const std::vector<double> &weight, const std::vector<BandShape> &shape)
    {
      const Loops<K>        loops(data, weight, shape);
      const Eigen::MatrixXd gram     = loops.gram_matrix();
      constexpr int         n_linear = 3 + K, n_curved = 3 * K;
      const auto            basis_data = gram.topRightCorner(n_linear, 2);

      const Eigen::LDLT<Eigen::MatrixXd> basis(gram.topLeftCorner(n_linear, n_linear));
      BandProjection                     p;
      p.coefficient    = basis.solve(basis_data);
      p.data_squares   = gram.bottomRightCorner(2, 2).trace();
      p.sum_of_squares = std::max(0., p.data_squares - p.coefficient.cwiseProduct(basis_data).sum());
      if (K == 0)
        return p;

      const Eigen::MatrixXd derivatives  = gram.block(n_linear, n_linear, n_curved, n_curved);
      const Eigen::MatrixXd mixed        = gram.block(0, n_linear, n_linear, n_curved);
      const Eigen::MatrixXd misfit_slope = gram.block(n_linear, n_linear + n_curved, n_curved, 2) -
                                           mixed.transpose() * p.coefficient;
      const auto curvature = loops.misfit_curvature(p.coefficient);
      p.descent            = Eigen::VectorXd::Zero(n_curved);
      p.gauss_newton = p.hessian = Eigen::MatrixXd::Zero(n_curved, n_curved);
      for (int m = 0; m < 2; ++m)
        {
          Eigen::VectorXd jump(n_curved);
          for (int k = 0; k < n_curved; ++k)
            jump[k] = p.coefficient(3 + k / 3, m);
          const Eigen::MatrixXd plain   = jump.asDiagonal() * derivatives * jump.asDiagonal();
          const Eigen::MatrixXd kaufman = mixed * jump.asDiagonal(); // linear coefficients x parameters
          Eigen::MatrixXd       full    = kaufman;
          for (int k = 0; k < n_curved; ++k)
            full(3 + k / 3, k) -= misfit_slope(k, m);
          p.descent += jump.cwiseProduct(misfit_slope.col(m));
          p.gauss_newton += plain - kaufman.transpose() * basis.solve(kaufman);
          p.hessian += plain - full.transpose() * basis.solve(full);
        }
      for (int b = 0; b < K; ++b)
        p.hessian.template block<3, 3>(3 * b, 3 * b) -= curvature[b].template selfadjointView<Eigen::Lower>();
      return p;
    }
  } // namespace

  double BandShape::profile(const Eigen::Vector2d &x) const
  {
    return fast_tanh((-std::sin(angle) * x.x() + std::cos(angle) * x.y() - offset) / half_width);
  }

  BandProjection project_bands(const BandData &data, const std::vector<double> &weight, const std::vector<BandShape> &shape)
  {
    switch (shape.size())
      {
      case 0:
        return projection<0>(data, weight, shape);
      case 1:
        return projection<1>(data, weight, shape);
      case 2:
        return projection<2>(data, weight, shape);
      default:
        throw std::invalid_argument("the fit takes at most two bands");
      }
  }
} // namespace diptych::coupling
