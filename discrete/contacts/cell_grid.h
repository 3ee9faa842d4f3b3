// diptych: grains of similar size sorted into cells
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
  // Some of the grains, sorted by the cell of their centre. With a period the columns wrap around. If grains are so far apart
  // that most cells would be empty, cells share bins. Time and memory therefore depend only on the number of grains.
  class CellGrid
  {
  public:
    // `members`: numbers of the grains, at least one. `cell_size` > 0 [length].
    CellGrid(const State &state, std::vector<int> members, double cell_size);

    template <class Visit> void visit_around(const Eigen::Vector2d &x, const double reach, Visit &&visit) const
    {
      std::int64_t from = raw_column(x.x() - reach), to = raw_column(x.x() + reach);
      if (period_ > 0 && to - from >= columns_)
        {
          from = 0;
          to   = columns_ - 1;
        }
      if (!(period_ > 0))
        {
          from = std::clamp<std::int64_t>(from, 0, columns_ - 1);
          to   = std::clamp<std::int64_t>(to, 0, columns_ - 1);
        }
      const std::int64_t bottom = row(x.y() - reach), top = row(x.y() + reach);
      if (is_shared_ && double(to - from + 1) * double(top - bottom + 1) > double(members_.size()))
        {
          for (const int grain : members_)
            visit(grain);
          return;
        }
      for (std::int64_t b = bottom; b <= top; ++b)
        for (std::int64_t a = from; a <= to; ++a)
          visit_cell(period_ > 0 ? wrapped(a) : a, b, visit);
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

    // Column without clamping and, with a period, without wrapping.
    std::int64_t raw_column(double x) const { return std::int64_t(bounded(std::floor((x - origin_.x()) / cell_size_.x()))); }
    std::int64_t column(const double x) const
    {
      return period_ > 0 ? wrapped(raw_column(x)) : std::clamp<std::int64_t>(raw_column(x), 0, columns_ - 1);
    }
    std::int64_t row(const double y) const
    {
      const double raw = bounded(std::floor((y - origin_.y()) / cell_size_.y()));
      return std::clamp<std::int64_t>(std::int64_t(raw), 0, rows_ - 1);
    }
    std::int64_t  wrapped(const std::int64_t c) const { return ((c % columns_) + columns_) % columns_; }
    static double bounded(const double number) { return std::clamp(number, -1e18, 1e18); }
    std::size_t   bin(std::int64_t column, std::int64_t row) const;

    std::vector<int>  members_;
    std::vector<Cell> cell_; // of each member, if bins are shared
    Eigen::Vector2d   origin_, cell_size_;
    std::int64_t      columns_ = 1, rows_ = 1;
    double            period_    = 0; // 0: not periodic
    bool              is_shared_ = false;
    std::size_t       n_bins_    = 1;
    CountedBins       bins_;
  };

  // Grids by grain size, the largest grains first. Within a grid the largest radius is less than four times the smallest. A
  // cell is as wide as the largest diameter. Most samples need one grid.
  struct SizedGrid
  {
    double   largest_radius;
    CellGrid grid;
  };
  std::vector<SizedGrid> sort_by_size(const State &state);
} // namespace diptych::discrete
