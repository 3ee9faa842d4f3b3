// diptych: columns of a history, and means over a range of progress
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace diptych::coupling
{
  using HistoryTable = std::map<std::string, std::vector<double>, std::less<>>; // by column name, one entry per row

  // The numeric columns of rows. visit_columns() must exist for the type of the rows.
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

  // Column by name. Throws std::invalid_argument if it is missing.
  const std::vector<double> &column(const HistoryTable &table, std::string_view name);

  // True if progress > from. `progress` is a sum of steps, and their rounding does not count.
  inline bool is_beyond(const double progress, const double from)
  {
    return progress > from + 1e-9 * std::abs(from);
  }

  // Mean of a column over the range [from, to] of the column `progress`. The rows are joined by straight lines, and the end
  // values continue beyond the ends. So rows at uneven distances are weighted by the range that they represent.
  double mean_over_progress(const HistoryTable &table, const std::string &name, double from, double to);

  // T/S = (mean of t) / (mean of s) over the range [from, to] of the progress. Columns: sxx, sxy, syx (if present) and syy.
  // Unlike the mean of t/s it gives less weight to moments of small load. NaN if the history does not reach `to`.
  double ratio_of_means(const HistoryTable &table, double from, double to);

  // For each row, the mean over the preceding `width` of progress; NaN before the first full width. Needs O(rows) operations.
  std::vector<double> running_mean(const HistoryTable &table, const std::string &name, double width);

  // Largest running mean, and the progress at the end of its range; NaN before the first full width.
  struct Peak
  {
    double value = NAN, progress = 0;
  };
  Peak peak_of_running_mean(const HistoryTable &table, const std::string &name, double width);

  double median(std::vector<double> values);
} // namespace diptych::coupling
