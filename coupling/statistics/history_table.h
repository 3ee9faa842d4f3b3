// diptych: columns of a history, and means over a range of the progress
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

namespace diptych::coupling
{
  using HistoryTable = std::map<std::string, std::vector<double>>; // by column name, one entry a row

  // The numbers of rows whose type has a visit_columns beside it.
  template <class Row> HistoryTable history_table(const std::vector<Row> &rows)
  {
    HistoryTable table;
    for (const Row &row : rows)
      visit_columns(row, [&](const char *name, const auto &value, const char *, const char *) {
        if constexpr (std::is_arithmetic_v<std::decay_t<decltype(value)>>)
          table[name].push_back(double(value));
      });
    return table;
  }

  // Column by name; throws std::invalid_argument when it is missing.
  const std::vector<double> &column(const HistoryTable &table, const std::string &name);

  // progress > from, of a progress that is a sum of steps: what their rounding adds does not count.
  inline bool is_beyond(const double progress, const double from)
  {
    return progress > from + 1e-9 * std::abs(from);
  }

  // Mean of a column over [from, to] of the column `progress`: integral of the broken line through its rows, held constant
  // beyond the ends. So that rows at uneven progress count by what they stand for.
  double mean_over_progress(const HistoryTable &table, const std::string &name, double from, double to);

  // The same over any ascending column.
  struct ColumnPair
  {
    std::string abscissa, ordinate;
  };
  double mean_over(const HistoryTable &table, const ColumnPair &names, double from, double to);

  // T/S: the mean of t over [from, to] of the progress over that of s, from the columns sxx, sxy, syx where there is one, and
  // syy. Unlike the mean of t/s it does not count moments of little load as much as others. NaN where the history does not reach
  // `to`.
  double ratio_of_means(const HistoryTable &table, double from, double to);

  // At every row the mean over the `width` of progress that ends there; NaN before the first full width. O(rows).
  std::vector<double> running_mean(const HistoryTable &table, const std::string &name, double width);

  // The broken line through (x, y), x ascending, at the points of a grid; NaN beyond its ends.
  std::vector<double> resampled(const std::vector<double> &x, const std::vector<double> &y, const std::vector<double> &grid);

  // Largest of the running means, and the progress at which its range ends.
  struct Peak
  {
    double value = 0, progress = 0;
  };
  Peak peak_of_running_mean(const HistoryTable &table, const std::string &name, double width);

  double median(std::vector<double> values);
} // namespace diptych::coupling
