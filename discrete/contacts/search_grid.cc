// diptych: grains of similar size sorted by place
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/contacts/search_grid.h"

#include <limits>
#include <map>

#include <Eigen/LU>

namespace diptych::discrete
{
  SearchGrid::SearchGrid(const State &state, std::vector<int> members, const double cell_size)
      : members_(std::move(members))
  {
    const double    n   = double(members_.size());
    Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const int i : members_)
      {
        low  = low.cwiseMin(state.grains.position[i]);
        high = high.cwiseMax(state.grains.position[i]);
      }
    origin_              = low;
    const auto number_of = [&](const double length) { return std::int64_t(std::clamp(length / cell_size, 1., 4 * n + 16)); };
    const auto beyond    = [&](const double length) { return std::int64_t(bounded(std::floor(length / cell_size))) + 1; };
    if (const Lattice *lattice = state.lattice())
      {
        const Eigen::Matrix2d inverse = lattice->vectors.inverse(); // its rows are 1/height long
        wraps_x_ = wraps_y_ = true;
        columns_            = number_of(1 / inverse.row(0).norm());
        rows_               = number_of(1 / inverse.row(1).norm());
        to_cells_           = Eigen::Vector2d(double(columns_), double(rows_)).asDiagonal() * inverse;
      }
    else
      {
        const PeriodicWidth *periodic = state.width();
        wraps_x_                      = periodic != nullptr;
        columns_                      = periodic ? number_of(periodic->width) : beyond(high.x() - low.x());
        rows_                         = beyond(high.y() - low.y());
        to_cells_ = Eigen::Vector2d(periodic ? double(columns_) / periodic->width : 1 / cell_size, 1 / cell_size).asDiagonal();
      }
    cells_per_length_ = to_cells_.rowwise().norm();
    is_shared_        = double(columns_) * double(rows_) > 16 * n + 64;
    n_bins_           = is_shared_ ? 2 * members_.size() + 1 : std::size_t(columns_ * rows_);
    cell_.reserve(members_.size());
    for (const int i : members_)
      cell_.push_back(cell_of(state.grains.position[i]));
    bins_.sort(n_bins_, members_.size(), [this](const unsigned int k, const auto &into) { into(bin(cell_[k][0], cell_[k][1])); });
  }

  std::size_t SearchGrid::bin(const std::int64_t column, const std::int64_t row) const
  {
    if (!is_shared_)
      return std::size_t(row * columns_ + column);
    // Multiplicative hash of column and row (D. E. Knuth, The Art of Computer Programming 3, 6.4). It separates neighbours.
    std::uint64_t h = std::uint64_t(column) * 0x9e3779b97f4a7c15u;
    h               = (h ^ (h >> 32) ^ std::uint64_t(row)) * 0xd6e8feb86659fd93u;
    return std::size_t((h ^ (h >> 32)) % n_bins_);
  }

  SearchGrid::Crowds SearchGrid::crowds() const
  {
    std::map<Cell, std::size_t> count;
    for (const Cell &cell : cell_)
      ++count[cell];
    Crowds     crowds;
    const auto fullest = std::max_element(count.begin(), count.end(),
                                          [](const auto &a, const auto &b) { return a.second < b.second; });
    visit_cell(fullest->first[0], fullest->first[1], [&](const int grain) { crowds.fullest.push_back(grain); });
    for (const auto &[cell, n] : count)
      crowds.squares += double(n) * double(n);
    return crowds;
  }

  std::vector<SizedGrid> sort_by_size(const State &state)
  {
    constexpr double                ratio = 4;
    const std::vector<double>      &r     = state.grains.radius;
    std::map<int, std::vector<int>> classes; // the largest first
    const double                    largest = r.empty() ? 0 : *std::max_element(r.begin(), r.end());
    for (std::size_t i = 0; i < r.size(); ++i)
      classes[int(std::log(largest / r[i]) / std::log(ratio))].push_back(int(i));
    std::vector<SizedGrid> grids;
    for (auto &[size, members] : classes)
      {
        double radius = 0;
        for (const int i : members)
          radius = std::max(radius, r[i]);
        grids.push_back({radius, SearchGrid(state, std::move(members), 2 * radius)});
      }
    return grids;
  }
} // namespace diptych::discrete
