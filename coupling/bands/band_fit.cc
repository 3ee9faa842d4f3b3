// diptych: least squares fit of tanh bands on an affine background by variable projection
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/bands/band_fit.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace diptych::coupling
{
  namespace
  {
    double clamped_half_width(const BandFitOptions &options, const BandShape &shape)
    {
      const double largest = std::max(options.smallest_half_width, largest_half_width(options, shape.angle));
      return std::clamp(shape.half_width, options.smallest_half_width, largest);
    }

    // The step is limited, so that bands neither jump nor leave the admissible widths.
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

    // Removes a half width that is held at its bound from the step, because it would block the others.
    void hold_bounded_widths(const std::vector<BandShape> &shape, const BandFitOptions &options, BandProjection &p)
    {
      for (std::size_t b = 0; b < shape.size(); ++b)
        {
          const Eigen::Index k        = 3 * b + 2;
          const bool         at_upper = shape[b].half_width >= (1 - 1e-9) * largest_half_width(options, shape[b].angle);
          const bool         at_lower = shape[b].half_width <= (1 + 1e-9) * options.smallest_half_width;
          if ((at_upper && p.descent[k] > 0) || (at_lower && p.descent[k] < 0))
            {
              for (Eigen::MatrixXd *matrix : {&p.gauss_newton, &p.hessian})
                {
                  matrix->row(k).setZero();
                  matrix->col(k).setZero();
                  (*matrix)(k, k) = 1;
                }
              p.descent[k] = 0;
            }
        }
    }

    // Newton's step if the second derivative is positive definite. Otherwise the Gauss-Newton step, which always descends.
    Eigen::VectorXd damped_step(const BandProjection &p, const double lambda)
    {
      const auto damped = [lambda](Eigen::MatrixXd matrix, const double floor) {
        matrix.diagonal() *= 1 + lambda;
        matrix.diagonal().array() += floor;
        return matrix;
      };
      const double                      floor = 1e-14 * p.gauss_newton.trace() + 1e-300;
      const Eigen::LLT<Eigen::MatrixXd> newton(damped(p.hessian, floor));
      if (newton.info() == Eigen::Success)
        return newton.solve(p.descent);
      return damped(p.gauss_newton, floor).ldlt().solve(p.descent);
    }

    bool minimise(const BandData            &data,
                  const std::vector<double> &weight,
                  const BandFitOptions      &options,
                  const double               tolerance,
                  BandFit                   &fit)
    {
      BandProjection p      = project_bands(data, weight, fit.shape);
      double         lambda = 1e-3;
      bool           small  = fit.shape.empty();
      for (int iteration = 0; iteration < 20 && !small && lambda < 1e8; ++iteration)
        {
          BandProjection held = p;
          hold_bounded_widths(fit.shape, options, held);
          const std::vector<BandShape> next = stepped(fit.shape, damped_step(held, lambda), options);
          const BandProjection         q    = project_bands(data, weight, next);
          ++fit.iterations;
          small = distance(fit.shape, next) < tolerance;
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

    // If both components have equal normal scatter, the median of the length is 1.1774 standard deviations.
    double robust_scale(std::vector<double> misfit, const double floor)
    {
      const auto middle = misfit.begin() + misfit.size() / 2;
      std::nth_element(misfit.begin(), middle, misfit.end());
      return std::max(floor, *middle / 1.1774);
    }

    std::vector<double> misfits(const BandData &data, const BandFit &fit)
    {
      std::vector<double> misfit(data.x.size());
      for (std::size_t i = 0; i < misfit.size(); ++i)
        misfit[i] = (data.u[i] - fit.at(data.x[i])).norm();
      return misfit;
    }

    std::vector<double> weights_of(const BandData &data, const std::vector<double> &misfit, const BandFitOptions &options)
    {
      const double        limit = options.huber_threshold * robust_scale(misfit, options.scale_floor);
      std::vector<double> weight(misfit.size());
      for (std::size_t i = 0; i < misfit.size(); ++i)
        weight[i] = data.w[i] * std::min(1., limit / std::max(misfit[i], 1e-300));
      return weight;
    }
  } // namespace

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

    std::vector<double> weight          = data.w;
    double              variance_before = -1;
    for (int round = 0; round < 15 && !fit.converged; ++round)
      {
        const std::vector<BandShape> before = fit.shape;
        const bool                   small  = minimise(data, weight, options, 1e-7, fit);

        const std::vector<double> misfit = misfits(data, fit);
        weight                           = weights_of(data, misfit, options);
        double squares = 0, sum = 0, lengths = 0, total = 0;
        for (std::size_t i = 0; i < misfit.size(); ++i)
          {
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

  BandFit refit_bands(const BandData &data, const BandFit &start, const BandFitOptions &options, const double tolerance)
  {
    BandFit fit    = start;
    fit.iterations = 0;
    fit.converged  = minimise(data, data.w, options, tolerance, fit);
    return fit;
  }

  std::vector<double> huber_weights(const BandData &data, const BandFit &fit, const BandFitOptions &options)
  {
    return weights_of(data, misfits(data, fit), options);
  }
} // namespace diptych::coupling
