// diptych: a plane divided into square bins, and items sorted into them
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Core>

#include "discrete/contacts/counted_bins.h"

namespace diptych::coupling
{
  // Columns and rows of bins that a box meets: [column_begin, column_end) x [row_begin, row_end).
  struct BinRange
  {
    int column_begin = 0, column_end = 0, row_begin = 0, row_end = 0;
  };

  // The bins are numbered row by row from below. Items in a bin are in ascending order, so the order depends only on the items.
  class BinGrid
  {
  public:
    BinGrid() = default;

    // Bins of side `size` > 0 that cover the box [length].
    BinGrid(const Eigen::Vector2d &lower, const Eigen::Vector2d &upper, const double size)
        : origin(lower),
          size(size),
          columns(1 + int((upper.x() - lower.x()) / size)),
          rows(1 + int((upper.y() - lower.y()) / size))
    {}

    double      bin_size() const { return size; }
    int         n_columns() const { return columns; }
    int         n_rows() const { return rows; }
    double      row_low(const int row) const { return origin.y() + row * size; }
    std::size_t number(const int row, const int column) const { return std::size_t(row) * columns + column; }

    std::size_t bin_of(const Eigen::Vector2d &x) const
    {
      return number(int((x.y() - origin.y()) / size), int((x.x() - origin.x()) / size));
    }

    // Bins that a box meets, clamped to the grid. The range is empty for a box outside the grid.
    BinRange range(const Eigen::Vector2d &lower, const Eigen::Vector2d &upper) const
    {
      BinRange result;
      result.column_begin = std::max(0, index(lower.x() - origin.x(), columns));
      result.column_end   = std::min(columns, 1 + index(upper.x() - origin.x(), columns));
      result.row_begin    = std::max(0, index(lower.y() - origin.y(), rows));
      result.row_end      = std::min(rows, 1 + index(upper.y() - origin.y(), rows));
      return result;
    }

    // Row and column of any point; the point may lie beyond the grid.
    int row_of(const Eigen::Vector2d &x) const { return int(std::floor((x.y() - origin.y()) / size)); }
    int column_of(const Eigen::Vector2d &x) const { return int(std::floor((x.x() - origin.x()) / size)); }

    template <class BinsOf> void sort(const std::size_t n, BinsOf &&bins_of)
    {
      bins.sort(std::size_t(columns) * rows, n, bins_of);
    }

    unsigned int                     begins(const std::size_t bin) const { return bins.begins(bin); }
    const std::vector<unsigned int> &sorted() const { return bins.sorted(); }

    template <class Action> void for_each_in(const std::size_t bin, Action &&action) const { bins.for_each_in(bin, action); }

    template <class Action> void for_each_in(const BinRange &range, Action &&action) const
    {
      for (int row = range.row_begin; row < range.row_end; ++row)
        for (int column = range.column_begin; column < range.column_end; ++column)
          for_each_in(number(row, column), action);
    }

  private:
    // The distance is clamped before the conversion because far points and NaN would overflow an int.
    int index(const double distance, const int n) const
    {
      return int(std::min(std::max(std::floor(distance / size), -1.), double(n)));
    }

    Eigen::Vector2d       origin  = Eigen::Vector2d::Zero();
    double                size    = 1;
    int                   columns = 0, rows = 0;
    discrete::CountedBins bins;
  };
} // namespace diptych::coupling
