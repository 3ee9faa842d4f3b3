// diptych: distributes extensive quantities of grains over cells, by one of several methods
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/averaging/averaging.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "coupling/averaging/averaging_methods.h"

namespace diptych::coupling
{
  namespace
  {
    void check(const AveragingOptions &options, const Carriers &c)
    {
      const auto rows_match = [](const Columns &columns, const std::size_t n) {
        return columns.cols() == 0 || std::size_t(columns.rows()) == n;
      };
      if (c.radius.size() != c.position.size() || !rows_match(c.of_grains, c.position.size()))
        throw std::invalid_argument("averaging needs one radius and one row of quantities per grain");
      if (c.half_size.size() != c.half.size() || !rows_match(c.uniform, c.half.size()) || !rows_match(c.tapered, c.half.size()))
        throw std::invalid_argument("averaging needs one size and one row of quantities per half branch");
      if (c.judge_nodes && c.uniform.cols() < 4)
        throw std::invalid_argument("averaging needs the moments of the half branches to check the nodal identity");
      for (const HalfBranch &half : c.half)
        if (half.grain >= c.position.size())
          throw std::invalid_argument("averaging: a half branch belongs to grain " + std::to_string(half.grain) + " of " +
                                      std::to_string(c.position.size()));
      if (!(options.width > 0 && c.mean_diameter > 0))
        throw std::invalid_argument("averaging needs a positive averaging_width and a positive mean diameter");
    }
  } // namespace

  CellSums distribute(const AveragingOptions &options, const TargetCells &target, const Carriers &given)
  {
    check(options, given);
    Carriers        wrapped;
    const Carriers *carriers = &given;
    if (target.period.any())
      {
        wrapped = given;
        for (Eigen::Vector2d &x : wrapped.position)
          x = target.wrapped(x);
        carriers = &wrapped;
      }
    const double width = options.width * given.mean_diameter;
    switch (options.method)
      {
      case AveragingMethod::segments:
        return average_by_segments(target, *carriers);
      case AveragingMethod::centroid:
        return average_by_centroid(target, *carriers);
      case AveragingMethod::laguerre:
        return average_by_laguerre(target, *carriers);
      case AveragingMethod::kernel:
        return average_by_kernel(target, *carriers, options.kernel, width);
      case AveragingMethod::projection:
        return average_by_projection(target, *carriers, width);
      }
    throw std::logic_error("averaging: this method is not implemented");
  }

  void refuse_contact(const discrete::ContactForce &contact)
  {
    throw std::invalid_argument("a contact joins grains " + std::to_string(contact.i) + " and " + std::to_string(contact.j) +
                                ", but at least one of them does not exist");
  }

  Carriers moment_carriers(const std::vector<Eigen::Vector2d>        &position,
                           const std::vector<double>                 &radius,
                           const std::vector<discrete::ContactForce> &contacts)
  {
    Carriers c;
    c.position = position;
    c.radius   = radius;
    for (const discrete::ContactForce &contact : contacts)
      if (!contact.force.isZero(0))
        for_each_half(contact, position,
                      [&](const unsigned int grain, const Eigen::Vector2d &l, const Eigen::Vector2d &f, double) {
                        c.half.push_back({grain, l});
                        c.half_size.push_back(f.norm() * l.norm());
                      });
    c.uniform.resize(Eigen::Index(c.half.size()), n_moment_columns);
    c.tapered.resize(Eigen::Index(c.half.size()), 2);
    Eigen::Index row = 0;
    for (const discrete::ContactForce &contact : contacts)
      if (!contact.force.isZero(0))
        for_each_half(contact, position, [&](unsigned int, const Eigen::Vector2d &l, const Eigen::Vector2d &f, const double m) {
          c.uniform.row(row)   = uniform_moments(l, f, m);
          c.tapered.row(row++) = tapered_couple(l, f);
        });
    return c;
  }

  Eigen::Matrix<double, 1, n_moment_columns> uniform_moments(const Eigen::Vector2d &l, const Eigen::Vector2d &f, const double m)
  {
    Eigen::Matrix<double, 1, n_moment_columns> row;
    row << -f.x() * l.x(), -f.x() * l.y(), -f.y() * l.x(), -f.y() * l.y(), -m * l.x(), -m * l.y();
    return row;
  }

  // (x_c - x) x f decreases linearly from l x f at the centre to zero at the contact point. Its integral is half of l x f.
  Eigen::RowVector2d tapered_couple(const Eigen::Vector2d &l, const Eigen::Vector2d &f)
  {
    return -0.5 * (l.x() * f.y() - l.y() * f.x()) * l.transpose();
  }

  std::vector<Eigen::Vector2d> couple_moments(const Carriers &moments)
  {
    std::vector<Eigen::Vector2d> of_grain(moments.position.size(), Eigen::Vector2d::Zero());
    for (std::size_t h = 0; h < moments.half.size(); ++h)
      of_grain[moments.half[h].grain] +=
        (moments.uniform.block<1, 2>(Eigen::Index(h), couple_moment) + moments.tapered.row(Eigen::Index(h))).transpose();
    return of_grain;
  }

  CellSums zero_sums(const TargetCells &target, const Carriers &carriers)
  {
    CellSums sums;
    sums.of_grains = Columns::Zero(target.n_cells(), carriers.of_grains.cols());
    sums.uniform   = Columns::Zero(target.n_cells(), carriers.uniform.cols());
    sums.tapered   = Columns::Zero(target.n_cells(), carriers.tapered.cols());
    return sums;
  }

  std::vector<double> joined_grains(const TargetCells &target, const Carriers &carriers, const GrainShares &shares)
  {
    if (!carriers.count_joined)
      return {};
    JoinedGrains                                 joined(target.n_cells());
    std::vector<std::pair<unsigned int, double>> row;
    for (std::size_t i = 0; i + 1 < shares.begin.size(); ++i)
      {
        row.clear();
        for (std::size_t k = shares.begin[i]; k < shares.begin[i + 1]; ++k)
          row.emplace_back(shares.cell[k], shares.share[k]);
        std::sort(row.begin(), row.end());
        for (std::size_t k = 0; k < row.size();)
          {
            const unsigned int cell  = row[k].first;
            double             share = 0;
            for (; k < row.size() && row[k].first == cell; ++k)
              share += row[k].second;
            joined.add(cell, share);
          }
      }
    return joined.numbers();
  }

  CellSums sums_by_owner(const TargetCells &target, const Carriers &carriers, const GrainShares &shares)
  {
    // The quantities of a grain's half branches are added first, because they all go to the same cells as the grain.
    Columns uniform = Columns::Zero(Eigen::Index(carriers.position.size()), carriers.uniform.cols());
    Columns tapered = Columns::Zero(Eigen::Index(carriers.position.size()), carriers.tapered.cols());
    double  outside = 0;
    for (std::size_t h = 0; h < carriers.half.size(); ++h)
      {
        const unsigned int grain = carriers.half[h].grain;
        if (carriers.uniform.cols() > 0)
          uniform.row(grain) += carriers.uniform.row(Eigen::Index(h));
        if (carriers.tapered.cols() > 0)
          tapered.row(grain) += carriers.tapered.row(Eigen::Index(h));
        outside += shares.outside[grain] ? carriers.half_size[h] : 0;
      }

    CellSums sums = zero_sums(target, carriers);
    for (std::size_t i = 0; i < carriers.position.size(); ++i)
      for (std::size_t k = shares.begin[i]; k < shares.begin[i + 1]; ++k)
        {
          if (carriers.of_grains.cols() > 0)
            sums.of_grains.row(shares.cell[k]) += shares.share[k] * carriers.of_grains.row(Eigen::Index(i));
          sums.uniform.row(shares.cell[k]) += shares.share[k] * uniform.row(Eigen::Index(i));
          sums.tapered.row(shares.cell[k]) += shares.share[k] * tapered.row(Eigen::Index(i));
        }
    const double size  = std::accumulate(carriers.half_size.begin(), carriers.half_size.end(), 0.);
    sums.outside_share = size > 0 ? outside / size : 0;
    sums.joined        = joined_grains(target, carriers, shares);
    return sums;
  }
} // namespace diptych::coupling
