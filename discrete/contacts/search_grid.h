// diptych: grains of similar size sorted by place
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "discrete/bodies/state.h"
#include "discrete/contacts/counted_bins.h"

namespace diptych::discrete
{
  // Some of the grains, sorted by the grid cell of their centre. With a periodic width the columns wrap around. In a lattice the
  // rows wrap, too, and grid cells are parallelograms. If grains are so far apart that most cells would be empty, cells share
  // bins. Time and memory therefore depend only on the number of grains.
  class SearchGrid
  {
  public:
    // `members`: numbers of the grains, at least one. `cell_size` > 0 [length].
    SearchGrid(const State &state, std::vector<int> members, double cell_size);

    template <class Visit> void visit_around(const Eigen::Vector2d &x, const double reach, Visit &&visit) const
    {
      const Eigen::Vector2d at = to_cells_ * (x - origin_), far = reach * cells_per_length_;
      const Range           columns = range(at.x() - far.x(), at.x() + far.x(), columns_, wraps_x_);
      const Range           rows    = range(at.y() - far.y(), at.y() + far.y(), rows_, wraps_y_);
      if (is_shared_ && double(columns.to - columns.from + 1) * double(rows.to - rows.from + 1) > double(members_.size()))
        {
          for (const int grain : members_)
            visit(grain);
          return;
        }
      for (std::int64_t b = rows.from; b <= rows.to; ++b)
        for (std::int64_t a = columns.from; a <= columns.to; ++a)
          visit_cell(placed(a, columns_, wraps_x_), placed(b, rows_, wraps_y_), visit);
    }

    struct Crowds
    {
      std::vector<int> fullest;     // members of the fullest cell, ascending
      double           squares = 0; // sum of n^2 over the cells, a measure of the number of close pairs
    };
    Crowds crowds() const;

  private:
    using Cell = std::array<std::int64_t, 2>; // column, row

    template <class Visit> void visit_cell(const std::int64_t column, const std::int64_t row, Visit &&visit) const
    {
      bins_.for_each_in(bin(column, row), [&](const unsigned int k) {
        if (!is_shared_ || cell_[k] == Cell{column, row})
          visit(members_[k]);
      });
    }

    struct Range
    {
      std::int64_t from, to;
    };

    // Numbers of the cells from `low` to `high` along one axis; beyond a period each cell counts once.
    static Range range(const double low, const double high, const std::int64_t n, const bool wraps)
    {
      const std::int64_t from = std::int64_t(bounded(std::floor(low))), to = std::int64_t(bounded(std::floor(high)));
      if (!wraps)
        return {std::clamp<std::int64_t>(from, 0, n - 1), std::clamp<std::int64_t>(to, 0, n - 1)};
      return to - from >= n ? Range{0, n - 1} : Range{from, to};
    }
    static std::int64_t placed(const std::int64_t c, const std::int64_t n, const bool wraps)
    {
      return wraps ? ((c % n) + n) % n : std::clamp<std::int64_t>(c, 0, n - 1);
    }
    Cell cell_of(const Eigen::Vector2d &x) const
    {
      const Eigen::Vector2d at = to_cells_ * (x - origin_);
      return {placed(std::int64_t(bounded(std::floor(at.x()))), columns_, wraps_x_),
              placed(std::int64_t(bounded(std::floor(at.y()))), rows_, wraps_y_)};
    }
    static double bounded(const double number) { return std::clamp(number, -1e18, 1e18); }
    std::size_t   bin(std::int64_t column, std::int64_t row) const;

    std::vector<int>  members_;
    std::vector<Cell> cell_; // of each member, if bins are shared
    Eigen::Vector2d   origin_;
    Eigen::Matrix2d   to_cells_;         // maps (position - origin) to columns and rows
    Eigen::Vector2d   cells_per_length_; // columns and rows that a distance can span
    std::int64_t      columns_ = 1, rows_ = 1;
    bool              wraps_x_ = false, wraps_y_ = false, is_shared_ = false;
    std::size_t       n_bins_ = 1;
    CountedBins       bins_;
  };

  // Grids by grain size, the largest grains first. Within a grid the largest radius is less than four times the smallest. A
  // cell is as wide as the largest diameter. Most samples need one grid.
  struct SizedGrid
  {
    double     largest_radius;
    SearchGrid grid;
  };
  std::vector<SizedGrid> sort_by_size(const State &state);
} // namespace diptych::discrete
