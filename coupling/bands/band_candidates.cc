// diptych: starting points of band fits, from scans over lines and pairs of lines
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/bands/band_candidates.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include <Eigen/QR>

#include "coupling/cells/principal_axes.h"

namespace diptych::coupling
{
  namespace
  {
    constexpr double pair_half_width     = 5;     // the half width of the three with which pairs are tried
    constexpr int    most_parallel_lines = 10000; // to each side of the centre

    void add_parallel_lines(const BandFitOptions   &sample,
                            const double            angle,
                            const double            half_width,
                            std::vector<BandShape> &lines)
    {
      const double width   = std::min(half_width, largest_half_width(sample, angle));
      const double spacing = std::max(2., std::min(0.75 * width, std::min(sample.width, sample.height) / 12));
      const double reach   = 1.7 * largest_half_width(sample, angle); // 85 % of half the extent along the normal
      if (!(reach / spacing <= most_parallel_lines))
        throw std::invalid_argument("the outline of the sample is so long that the band search would scan " +
                                    std::to_string(2 * reach / spacing) + " lines of each angle; at most " +
                                    std::to_string(2 * most_parallel_lines) + " are possible");
      for (double offset = -reach; offset <= reach; offset += spacing)
        lines.push_back({angle, offset, half_width});
    }
  } // namespace

  BandData block_means(const BandData &data, const double size)
  {
    std::map<std::pair<int, int>, std::size_t> block;
    BandData                                   means;
    for (std::size_t i = 0; i < data.x.size(); ++i)
      {
        const std::pair<int, int> key(static_cast<int>(std::floor(data.x[i].x() / size)),
                                      static_cast<int>(std::floor(data.x[i].y() / size)));
        const auto [entry, is_new] = block.emplace(key, means.x.size());
        if (is_new)
          {
            means.x.push_back(Eigen::Vector2d::Zero());
            means.u.push_back(Eigen::Vector2d::Zero());
            means.w.push_back(0);
          }
        means.x[entry->second] += data.w[i] * data.x[i];
        means.u[entry->second] += data.w[i] * data.u[i];
        means.w[entry->second] += data.w[i];
      }
    for (std::size_t b = 0; b < means.x.size(); ++b)
      {
        means.x[b] /= means.w[b];
        means.u[b] /= means.w[b];
      }
    return means;
  }

  bool distinct(const BandShape &a, const BandShape &b, const double angle, const double separation)
  {
    if (std::abs(std::remainder(a.angle - b.angle, M_PI)) >= angle)
      return true;
    // Offsets change sign with the normal if the angles lie on different sides of +-90 degrees.
    const double sign = std::cos(a.angle - b.angle) < 0 ? -1 : 1;
    return std::abs(a.offset - sign * b.offset) >= separation;
  }

  LineScan::LineScan(const BandData &blocks, const BandFitOptions &sample)
      : root_weight(Eigen::Map<const Eigen::VectorXd>(blocks.w.data(), blocks.w.size()).cwiseSqrt()),
        position(blocks.w.size(), 2),
        data(blocks.w.size(), 2),
        smallest_square(1e-4 * root_weight.squaredNorm())
  {
    Eigen::MatrixXd background(blocks.w.size(), 3);
    for (std::size_t i = 0; i < blocks.w.size(); ++i)
      {
        background.row(i) << root_weight[i], root_weight[i] * blocks.x[i].transpose();
        position.row(i) = blocks.x[i];
        data.row(i)     = root_weight[i] * blocks.u[i].transpose();
      }
    affine = Eigen::HouseholderQR<Eigen::MatrixXd>(background).householderQ() *
             Eigen::MatrixXd::Identity(background.rows(), background.cols());

    for (double angle = -88; angle <= 90; angle += 4)
      for (const double half_width : {2., pair_half_width, 12.})
        add_parallel_lines(sample, angle * degree, half_width, lines);
    profiles.resize(blocks.w.size(), lines.size());
    for (std::size_t k = 0; k < lines.size(); ++k)
      profiles.col(k) = affine_free_profile(lines[k]);
  }

  Eigen::VectorXd LineScan::affine_free_profile(const BandShape &shape) const
  {
    // tanh(z) = 1 - 2 / (exp(2 z) + 1), for all blocks at once.
    const Eigen::Vector2d normal(-std::sin(shape.angle), std::cos(shape.angle));
    const Eigen::ArrayXd  z      = ((position * normal).array() - shape.offset) / shape.half_width;
    const Eigen::VectorXd column = root_weight.array() * (1 - 2 / ((2 * z).exp() + 1));
    return column - affine * (affine.transpose() * column);
  }

  // A profile q that is orthogonal to the known bands lowers the sum of squares by |q.u|^2 / |q|^2.
  std::vector<BandShape> LineScan::best_lines(const std::vector<BandShape> &known, const std::size_t n_best) const
  {
    Eigen::MatrixXd product = profiles.transpose() * data;
    Eigen::VectorXd square  = profiles.colwise().squaredNorm();
    if (!known.empty())
      {
        Eigen::MatrixXd basis(profiles.rows(), known.size());
        for (std::size_t b = 0; b < known.size(); ++b)
          basis.col(b) = affine_free_profile(known[b]);
        basis = (Eigen::HouseholderQR<Eigen::MatrixXd>(basis).householderQ() *
                 Eigen::MatrixXd::Identity(basis.rows(), basis.cols()))
                  .eval();
        const Eigen::MatrixXd shares = basis.transpose() * profiles;
        product -= shares.transpose() * (basis.transpose() * data);
        square -= shares.colwise().squaredNorm().transpose();
      }

    std::vector<double> gain(lines.size(), 0.);
    for (std::size_t k = 0; k < lines.size(); ++k)
      if (square[k] > smallest_square)
        gain[k] = product.row(k).squaredNorm() / square[k];
    std::vector<std::size_t> order(lines.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&gain](const auto a, const auto b) { return gain[a] > gain[b]; });

    std::vector<BandShape> best;
    for (const std::size_t k : order)
      if (best.size() < n_best && std::all_of(best.begin(), best.end(), [&](const BandShape &chosen) {
            return distinct(chosen, lines[k], 12 * degree, 8.);
          }))
        best.push_back(lines[k]);
    return best;
  }

  std::vector<BandShape> LineScan::best_pair() const
  {
    std::vector<int> chosen;
    for (std::size_t k = 0; k < lines.size(); ++k)
      if (lines[k].half_width == pair_half_width && std::lround(lines[k].angle / degree) % 8 == 0)
        chosen.push_back(k);
    const Eigen::MatrixXd columns = profiles(Eigen::all, chosen);
    const Eigen::MatrixXd product = columns.transpose() * data;
    Eigen::MatrixXd       gram(columns.cols(), columns.cols());
    gram.triangularView<Eigen::Upper>() = columns.transpose() * columns;

    double                 best_gain = 0;
    std::vector<BandShape> best;
    for (Eigen::Index a = 0; a < gram.rows(); ++a)
      for (Eigen::Index b = a + 1; b < gram.rows(); ++b)
        {
          const BandShape &first = lines[chosen[a]], &second = lines[chosen[b]];
          const double     determinant = gram(a, a) * gram(b, b) - gram(a, b) * gram(a, b);
          if (determinant < 0.2 * gram(a, a) * gram(b, b) || gram(a, a) < smallest_square || gram(b, b) < smallest_square ||
              !distinct(first, second, 20 * degree, 12.))
            continue;
          const double gain = (gram(b, b) * product.row(a).squaredNorm() + gram(a, a) * product.row(b).squaredNorm() -
                               2 * gram(a, b) * product.row(a).dot(product.row(b))) /
                              determinant;
          if (gain > best_gain)
            {
              best_gain = gain;
              best      = {first, second};
            }
        }
    return best;
  }
} // namespace diptych::coupling
