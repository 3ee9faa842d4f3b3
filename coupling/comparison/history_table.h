// diptych: columns of a history file, and means over a range of axial strain
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

namespace diptych::coupling
{
  using HistoryTable = std::map<std::string, std::vector<double>>; // by column name, one entry a row

  // Reads a comma-separated file with column names in its first line. Throws std::runtime_error naming file and line.
  HistoryTable read_history(const std::string &csv_path);

  // Column by name; throws std::runtime_error when it is missing.
  const std::vector<double> &column(const HistoryTable &table, const std::string &name);

  // Mean of a column over [from, to] of axial_strain: integral of the broken line through its rows, held constant
  // beyond the ends. So that rows at uneven strains count by the strain they stand for.
  double mean_over_strain(const HistoryTable &table, const std::string &name, double from, double to);

  // The same over any ascending column.
  struct ColumnPair
  {
    std::string abscissa, ordinate;
  };
  double mean_over(const HistoryTable &table, const ColumnPair &names, double from, double to);

  // Largest of the running means over `width` of axial strain that end at a row, and the strain at which its range ends.
  struct Peak
  {
    double value = 0, axial_strain = 0;
  };
  Peak peak_of_running_mean(const HistoryTable &table, const std::string &name, double width);

  double median(std::vector<double> values);
} // namespace diptych::coupling
