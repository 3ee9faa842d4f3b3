// diptych: least squares fit of tanh bands on an affine background by variable projection
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/band_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include <Eigen/Cholesky>

namespace diptych::coupling
{
  namespace
  {
    // tanh to 1e-16 absolute, which is what a fit needs, at a fourth of std::tanh's cost.
    double fast_tanh(const double z)
    {
      return 1 - 2 / (std::exp(2 * z) + 1);
    }

    // The problem after the linear coefficients are eliminated (Golub & Pereyra 1973, with Kaufman's Jacobian). Nonlinear
    // parameters are ordered angle, offset, log half width of each band.
    struct Projection
    {
      double                                   sum_of_squares = 0;
      double                                   data_squares   = 0;
      Eigen::Matrix<double, Eigen::Dynamic, 2> coefficient;
      Eigen::MatrixXd                          hessian;
      Eigen::VectorXd                          descent; // minus half the gradient
    };

    // Columns: affine (3), profiles (K), their derivatives (3 K), data (2): one weighted Gram matrix holds all that a step needs.
    // K is fixed at compile time because this loop over all points is where the time goes.
    template <int K>
    Eigen::MatrixXd gram_matrix_of(const BandData &data, const std::vector<double> &weight, const std::vector<BandShape> &shape)
    {
      constexpr int                  n    = 5 + 4 * K;
      Eigen::Matrix<double, n, n>    gram = Eigen::Matrix<double, n, n>::Zero();
      std::array<Eigen::Vector2d, K> along, normal;
      for (int b = 0; b < K; ++b)
        {
          along[b]  = {std::cos(shape[b].angle), std::sin(shape[b].angle)};
          normal[b] = {-along[b].y(), along[b].x()};
        }

      Eigen::Matrix<double, n, 1> row;
      for (std::size_t i = 0; i < data.x.size(); ++i)
        {
          row.template head<3>() << 1, data.x[i].x(), data.x[i].y();
          for (int b = 0; b < K; ++b)
            {
              const double z       = (normal[b].dot(data.x[i]) - shape[b].offset) / shape[b].half_width;
              const double profile = fast_tanh(z);
              const double slope   = 1 - profile * profile;
              row[3 + b]           = profile;
              row.template segment<3>(3 + K + 3 * b) << -slope * along[b].dot(data.x[i]) / shape[b].half_width,
                -slope / shape[b].half_width, -slope * z;
            }
          row.template tail<2>() = data.u[i];
          gram.noalias() += (weight[i] * row) * row.transpose();
        }
      return gram;
    }

    Eigen::MatrixXd gram_matrix(const BandData &data, const std::vector<double> &weight, const std::vector<BandShape> &shape)
    {
      switch (shape.size())
        {
        case 0:
          return gram_matrix_of<0>(data, weight, shape);
        case 1:
          return gram_matrix_of<1>(data, weight, shape);
        case 2:
          return gram_matrix_of<2>(data, weight, shape);
        default:
          throw std::invalid_argument("at most two bands can be fitted");
        }
    }

    Projection project(const BandData &data, const std::vector<double> &weight, const std::vector<BandShape> &shape)
    {
      const Eigen::MatrixXd gram     = gram_matrix(data, weight, shape);
      const Eigen::Index    n_linear = 3 + shape.size(), n_curved = 3 * shape.size();
      const auto            basis       = gram.topLeftCorner(n_linear, n_linear);
      const auto            derivatives = gram.block(n_linear, n_linear, n_curved, n_curved);
      const auto            mixed       = gram.block(0, n_linear, n_linear, n_curved);
      const auto            basis_data  = gram.topRightCorner(n_linear, 2);

      const Eigen::LDLT<Eigen::MatrixXd> solver(basis);
      Projection                         p;
      p.coefficient    = solver.solve(basis_data);
      p.data_squares   = gram.bottomRightCorner(2, 2).trace();
      p.sum_of_squares = std::max(0., p.data_squares - p.coefficient.cwiseProduct(basis_data).sum());
      if (n_curved == 0)
        return p;

      const Eigen::MatrixXd projected    = derivatives - mixed.transpose() * solver.solve(Eigen::MatrixXd(mixed));
      const Eigen::MatrixXd misfit_slope = gram.block(n_linear, n_linear + n_curved, n_curved, 2) -
                                           mixed.transpose() * p.coefficient;
      p.hessian.resize(n_curved, n_curved);
      p.descent.resize(n_curved);
      for (Eigen::Index k = 0; k < n_curved; ++k)
        {
          p.descent[k] = p.coefficient.row(3 + k / 3).dot(misfit_slope.row(k));
          for (Eigen::Index l = 0; l < n_curved; ++l)
            p.hessian(k, l) = p.coefficient.row(3 + k / 3).dot(p.coefficient.row(3 + l / 3)) * projected(k, l);
        }
      return p;
    }

    double clamped_half_width(const BandFitOptions &options, const BandShape &shape)
    {
      const double largest = std::max(options.smallest_half_width, largest_half_width(options, shape.angle));
      return std::clamp(shape.half_width, options.smallest_half_width, largest);
    }

    // A step within the trust limits: bands neither jump nor leave the admissible widths.
    std::vector<BandShape> stepped(const std::vector<BandShape> &shape,
                                   const Eigen::VectorXd        &step,
                                   const BandFitOptions         &options)
    {
      std::vector<BandShape> next = shape;
      for (std::size_t b = 0; b < shape.size(); ++b)
        {
          const double reach = 3 * shape[b].half_width;
          next[b].angle += std::clamp(step[3 * b], -0.2, 0.2);
          next[b].offset += std::clamp(step[3 * b + 1], -reach, reach);
          next[b].half_width *= std::exp(std::clamp(step[3 * b + 2], -0.7, 0.7));
          next[b].half_width = clamped_half_width(options, next[b]);
        }
      return next;
    }

    double distance(const std::vector<BandShape> &a, const std::vector<BandShape> &b)
    {
      double largest = 0;
      for (std::size_t k = 0; k < a.size(); ++k)
        largest = std::max({largest, std::abs(a[k].angle - b[k].angle), std::abs(a[k].offset - b[k].offset) / a[k].half_width,
                            std::abs(std::log(a[k].half_width / b[k].half_width))});
      return largest;
    }

    // A half width held at its bound takes no part in the step, else the others would wait for it.
    void hold_bounded_widths(const std::vector<BandShape> &shape, const BandFitOptions &options, Projection &p)
    {
      for (std::size_t b = 0; b < shape.size(); ++b)
        {
          const Eigen::Index k        = 3 * b + 2;
          const bool         at_upper = shape[b].half_width >= (1 - 1e-9) * largest_half_width(options, shape[b].angle);
          const bool         at_lower = shape[b].half_width <= (1 + 1e-9) * options.smallest_half_width;
          if ((at_upper && p.descent[k] > 0) || (at_lower && p.descent[k] < 0))
            {
              p.hessian.row(k).setZero();
              p.hessian.col(k).setZero();
              p.hessian(k, k) = 1;
              p.descent[k]    = 0;
            }
        }
    }

    // Levenberg-Marquardt with fixed weights; returns whether the step became small.
    bool minimise(const BandData &data, const std::vector<double> &weight, const BandFitOptions &options, BandFit &fit)
    {
      Projection p      = project(data, weight, fit.shape);
      double     lambda = 1e-3;
      bool       small  = fit.shape.empty();
      for (int iteration = 0; iteration < 12 && !small && lambda < 1e8; ++iteration)
        {
          Projection held = p;
          hold_bounded_widths(fit.shape, options, held);
          Eigen::MatrixXd damped = held.hessian;
          damped.diagonal() *= 1 + lambda;
          damped.diagonal().array() += 1e-14 * held.hessian.trace() + 1e-300;
          const std::vector<BandShape> next = stepped(fit.shape, damped.ldlt().solve(held.descent), options);
          const Projection             q    = project(data, weight, next);
          ++fit.iterations;
          small = distance(fit.shape, next) < 1e-7;
          if (q.sum_of_squares <= p.sum_of_squares + 1e-14 * p.data_squares)
            {
              fit.shape = next;
              p         = q;
              lambda    = std::max(1e-12, 0.1 * lambda);
            }
          else
            lambda *= 10;
        }
      fit.coefficient = p.coefficient;
      return small;
    }

    // For two components of equal normal scatter the median of the length is 1.1774 standard deviations.
    double robust_scale(std::vector<double> misfit, const double floor)
    {
      const auto middle = misfit.begin() + misfit.size() / 2;
      std::nth_element(misfit.begin(), middle, misfit.end());
      return std::max(floor, *middle / 1.1774);
    }
  } // namespace

  double BandShape::profile(const Eigen::Vector2d &x) const
  {
    return fast_tanh((-std::sin(angle) * x.x() + std::cos(angle) * x.y() - offset) / half_width);
  }

  double largest_half_width(const BandFitOptions &options, const double angle)
  {
    return 0.25 * (options.width * std::abs(std::sin(angle)) + options.height * std::abs(std::cos(angle)));
  }

  Eigen::Vector2d BandFit::at(const Eigen::Vector2d &x) const
  {
    Eigen::Vector2d u = coefficient.row(0) + x.x() * coefficient.row(1) + x.y() * coefficient.row(2);
    for (std::size_t b = 0; b < shape.size(); ++b)
      u += coefficient.row(3 + b) * shape[b].profile(x);
    return u;
  }

  BandFit fit_bands(const BandData &data, const std::vector<BandShape> &start, const BandFitOptions &options)
  {
    BandFit fit;
    fit.shape = start;
    for (auto &shape : fit.shape)
      shape.half_width = clamped_half_width(options, shape);

    std::vector<double> weight          = data.w, misfit(data.x.size());
    double              variance_before = -1;
    for (int round = 0; round < 15 && !fit.converged; ++round)
      {
        const std::vector<BandShape> before = fit.shape;
        const bool                   small  = minimise(data, weight, options, fit);

        for (std::size_t i = 0; i < misfit.size(); ++i)
          misfit[i] = (data.u[i] - fit.at(data.x[i])).norm();
        const double scale   = robust_scale(misfit, options.scale_floor);
        double       squares = 0, sum = 0, lengths = 0, total = 0;
        for (std::size_t i = 0; i < misfit.size(); ++i)
          {
            weight[i] = data.w[i] * std::min(1., options.huber_threshold * scale / std::max(misfit[i], 1e-300));
            squares += weight[i] * misfit[i] * misfit[i];
            sum += weight[i];
            lengths += data.w[i] * misfit[i];
            total += data.w[i];
          }
        fit.robust_variance = 0.5 * squares / sum;
        fit.mean_misfit     = lengths / total;
        fit.converged       = small && round > 0 && distance(before, fit.shape) < 1e-4 &&
                        std::abs(fit.robust_variance - variance_before) <= 1e-3 * fit.robust_variance + 1e-16;
        variance_before = fit.robust_variance;
      }
    return fit;
  }
} // namespace diptych::coupling
