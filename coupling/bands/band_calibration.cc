// diptych: factors that widen the bootstrap intervals of a band, from simulated errors of known correlation
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/bands/band_calibration.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <Eigen/Cholesky>
#include <Eigen/SparseCore>

#include "coupling/bands/band_candidates.h"

namespace diptych::coupling
{
  namespace
  {
    constexpr int n_simulated = 400;

    // A mean over a third of a block loses little of errors that are smooth over a block. A mean over a half width loses little
    // of the profiles.
    double cell_size(const BandFit &fit, const BootstrapOptions &bootstrap)
    {
      double size = bootstrap.block / 3;
      for (const BandShape &shape : fit.shape)
        size = std::min(size, std::max(1.5, shape.half_width));
      return size;
    }

    // Derivatives of the model at the points: the rows of u_x, then those of u_y. Columns: angle, offset and log half width of
    // each band, then the linear coefficients for u_x and u_y in turn.
    Eigen::MatrixXd model_derivatives(const BandData &data, const BandFit &fit)
    {
      const Eigen::Index n = data.x.size(), n_bands = fit.shape.size();
      Eigen::MatrixXd    derivative = Eigen::MatrixXd::Zero(2 * n, 3 * n_bands + 2 * (3 + n_bands));
      for (Eigen::Index i = 0; i < n; ++i)
        {
          Eigen::VectorXd basis(3 + n_bands);
          basis.head<3>() << 1, data.x[i].x(), data.x[i].y();
          for (Eigen::Index b = 0; b < n_bands; ++b)
            {
              const BandShape         &shape = fit.shape[b];
              const Eigen::Vector2d    along(std::cos(shape.angle), std::sin(shape.angle)), across(-along.y(), along.x());
              const double             profile = shape.profile(data.x[i]), slope = (1 - profile * profile) / shape.half_width;
              const Eigen::RowVector3d by_shape(-slope * along.dot(data.x[i]), -slope,
                                                -slope * (across.dot(data.x[i]) - shape.offset));
              basis[3 + b] = profile;
              for (int c = 0; c < 2; ++c)
                derivative.block<1, 3>(c * n + i, 3 * b) = fit.coefficient(3 + b, c) * by_shape;
            }
          for (int c = 0; c < 2; ++c)
            for (Eigen::Index j = 0; j < basis.size(); ++j)
              derivative(c * n + i, 3 * n_bands + 2 * j + c) = basis[j];
        }
      return derivative;
    }

    // Derivatives of band_numbers() with respect to the model's parameters, five rows per band.
    Eigen::MatrixXd number_derivatives(const BandFit &fit)
    {
      const Eigen::Index n_bands    = fit.shape.size();
      Eigen::MatrixXd    derivative = Eigen::MatrixXd::Zero(5 * n_bands, 3 * n_bands + 2 * (3 + n_bands));
      for (Eigen::Index b = 0; b < n_bands; ++b)
        {
          const Eigen::Index    jump = 3 * n_bands + 2 * (3 + b);
          const Eigen::Vector2d half = fit.coefficient.row(3 + b).transpose();
          const double sign = half.dot(Eigen::Vector2d(std::cos(fit.shape[b].angle), std::sin(fit.shape[b].angle))) < 0 ? -1 : 1;
          derivative(5 * b, 3 * b)                = 1;
          derivative(5 * b + 1, 3 * b + 2)        = 1;
          derivative(5 * b + 2, 3 * b + 1)        = 1;
          derivative.block<1, 2>(5 * b + 3, jump) = sign * 2 * half.normalized().transpose();
          derivative.block<1, 2>(5 * b + 4, jump) << -sign * half.y() / half.squaredNorm(), sign * half.x() / half.squaredNorm();
          derivative(5 * b + 4, 3 * b) = -sign;
        }
      return derivative;
    }

    // Points x simulations. White noise on a grid of spacing 1.5 w is smoothed with exp(-r^2/(2 w^2)). It then has the
    // correlation exp(-r^2/(4 w^2)), whose integral over the plane is 4 pi w^2 = (correlation length)^2. The amplitude does not
    // matter.
    Eigen::MatrixXd simulated_errors(const BandData &data, const double correlation_length, const int n, const std::uint64_t seed)
    {
      const double   w = correlation_length / std::sqrt(4 * M_PI), spacing = 1.5 * w;
      constexpr int  reach = 2; // the smoothing is cut at 3 w
      Eigen::Array2d low = Eigen::Array2d::Constant(INFINITY), high = -low;
      for (const Eigen::Vector2d &x : data.x)
        {
          low  = low.min(x.array());
          high = high.max(x.array());
        }
      const Eigen::Array2i size = ((high - low) / spacing).cast<int>() + 2 * reach + 2;

      std::vector<Eigen::Triplet<double>> entries;
      for (std::size_t i = 0; i < data.x.size(); ++i)
        {
          const Eigen::Array2d place  = (data.x[i].array() - low) / spacing + reach;
          const Eigen::Array2i centre = place.round().cast<int>();
          for (int column = centre.x() - reach; column <= centre.x() + reach; ++column)
            for (int row = centre.y() - reach; row <= centre.y() + reach; ++row)
              {
                const double square = (place - Eigen::Array2d(column, row)).square().sum() * 1.5 * 1.5;
                entries.emplace_back(i, column + size.x() * row, std::exp(-0.5 * square));
              }
        }
      Eigen::SparseMatrix<double, Eigen::RowMajor> smoothing(data.x.size(), size.prod());
      smoothing.setFromTriplets(entries.begin(), entries.end());

      // Uniform instead of normal numbers suffice, because each smoothed value sums about a dozen of them.
      std::mt19937_64 random(seed);
      Eigen::MatrixXd white(size.prod(), n);
      for (Eigen::Index k = 0; k < white.size(); ++k)
        white.data()[k] = (random() >> 11) * 0x1p-53 - 0.5;
      return smoothing * white;
    }

    // Variance over drawn blocks of each row of `influence` (numbers x 2 n) times the residuals (2 n x simulations). It is the
    // sum of the squares of the blocks' sums. These sums add up to zero because the residuals are those of a fit.
    Eigen::ArrayXXd block_variance(const Eigen::MatrixXd  &influence,
                                   const Eigen::MatrixXd  &residual,
                                   const std::vector<int> &block,
                                   const int               n_blocks)
    {
      const Eigen::Index    n         = block.size();
      const Eigen::MatrixXd transpose = residual.transpose();
      Eigen::ArrayXXd       variance(influence.rows(), residual.cols());
      for (Eigen::Index k = 0; k < influence.rows(); ++k)
        {
          Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(residual.cols(), n_blocks);
          for (Eigen::Index i = 0; i < n; ++i)
            sums.col(block[i]) += influence(k, i) * transpose.col(i) + influence(k, n + i) * transpose.col(n + i);
          variance.row(k) = sums.rowwise().squaredNorm().transpose();
        }
      return variance;
    }
  } // namespace

  BandNumbers band_numbers(const BandFit &fit, const std::size_t band)
  {
    const BandShape      &shape = fit.shape[band];
    const Eigen::Vector2d s(std::cos(shape.angle), std::sin(shape.angle)), n(-s.y(), s.x());
    const Eigen::Vector2d jump = 2 * fit.coefficient.row(3 + band).transpose();
    return {{shape.angle, std::log(shape.half_width), shape.offset, std::copysign(jump.norm(), jump.dot(s)),
             std::atan2(jump.dot(n), std::abs(jump.dot(s)))}};
  }

  std::vector<BandNumbers> bootstrap_factors(const BandData         &data,
                                             const BandFit          &fit,
                                             const Tiles            &tiles,
                                             const BootstrapOptions &bootstrap)
  {
    const BandData        cells     = block_means(data, cell_size(fit, bootstrap));
    const Eigen::Index    n         = cells.x.size();
    const Eigen::MatrixXd model     = model_derivatives(cells, fit);
    const Eigen::VectorXd weight    = Eigen::Map<const Eigen::VectorXd>(cells.w.data(), n).replicate(2, 1);
    const Eigen::MatrixXd weighted  = weight.asDiagonal() * model;
    const Eigen::MatrixXd solution  = (model.transpose() * weighted).ldlt().solve(weighted.transpose());
    const Eigen::MatrixXd influence = number_derivatives(fit) * solution;

    Eigen::MatrixXd       error(2 * n, n_simulated);
    const Eigen::MatrixXd both = simulated_errors(cells, bootstrap.block, 2 * n_simulated, bootstrap.seed);
    error << both.leftCols(n_simulated), both.rightCols(n_simulated);
    std::vector<int> block;
    for (const Eigen::Vector2d &x : cells.x)
      block.push_back(tiles.tile(x));
    const Eigen::ArrayXXd variance = block_variance(influence, error - model * (solution * error), block, tiles.count());
    const Eigen::ArrayXXd root     = (influence * error).array().abs() / variance.sqrt();

    std::vector<BandNumbers> factors(fit.shape.size());
    for (Eigen::Index k = 0; k < root.rows(); ++k)
      {
        std::vector<double> roots(root.cols());
        Eigen::Map<Eigen::ArrayXd>(roots.data(), roots.size()) = root.row(k).transpose();
        factors[k / 5][k % 5]                                  = std::max(1., quantile(std::move(roots), 0.95) / 1.959964);
      }
    return factors;
  }
} // namespace diptych::coupling
