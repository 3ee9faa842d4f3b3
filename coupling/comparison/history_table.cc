// diptych: columns of a history file, and means over a range of axial strain
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/comparison/history_table.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace diptych::coupling
{
  namespace
  {
    std::vector<std::string> split(const std::string &line)
    {
      std::vector<std::string> fields;
      std::stringstream        in(line);
      for (std::string field; std::getline(in, field, ',');)
        fields.push_back(field);
      return fields;
    }

    // Value at x of the broken line through (xs, ys); xs ascending.
    double interpolate(const std::vector<double> &xs, const std::vector<double> &ys, const double x)
    {
      if (x <= xs.front())
        return ys.front();
      if (x >= xs.back())
        return ys.back();
      const std::size_t k = std::upper_bound(xs.begin(), xs.end(), x) - xs.begin();
      return ys[k - 1] + (ys[k] - ys[k - 1]) * (x - xs[k - 1]) / (xs[k] - xs[k - 1]);
    }
  } // namespace

  HistoryTable read_history(const std::string &csv_path)
  {
    std::ifstream file(csv_path);
    std::string   line;
    if (!std::getline(file, line))
      throw std::runtime_error(csv_path + ": missing or empty");
    const std::vector<std::string> names = split(line);
    HistoryTable                   table;
    for (const std::string &name : names)
      table[name] = {};
    for (int number = 2; std::getline(file, line); ++number)
      {
        const std::vector<std::string> fields = split(line);
        if (fields.size() != names.size())
          throw std::runtime_error(csv_path + ", line " + std::to_string(number) + ": " + std::to_string(fields.size()) +
                                   " values for " + std::to_string(names.size()) + " columns");
        for (std::size_t k = 0; k < names.size(); ++k)
          table[names[k]].push_back(fields[k] == "nan" || fields[k] == "-nan" ? std::numeric_limits<double>::quiet_NaN()
                                                                              : std::stod(fields[k]));
      }
    if (column(table, "axial_strain").empty())
      throw std::runtime_error(csv_path + ": holds no row");
    return table;
  }

  const std::vector<double> &column(const HistoryTable &table, const std::string &name)
  {
    const auto found = table.find(name);
    if (found == table.end())
      throw std::runtime_error("the history has no column '" + name + "'");
    return found->second;
  }

  double mean_over_strain(const HistoryTable &table, const std::string &name, const double from, const double to)
  {
    return mean_over(table, {"axial_strain", name}, from, to);
  }

  double mean_over(const HistoryTable &table, const ColumnPair &names, const double from, const double to)
  {
    const std::vector<double> &xs = column(table, names.abscissa), &ys = column(table, names.ordinate);
    double                     integral = 0, x = from, y = interpolate(xs, ys, from);
    for (std::size_t k = std::upper_bound(xs.begin(), xs.end(), from) - xs.begin(); x < to; ++k)
      {
        const double next_x = k < xs.size() ? std::min(xs[k], to) : to, next_y = interpolate(xs, ys, next_x);
        integral += 0.5 * (y + next_y) * (next_x - x);
        x = next_x, y = next_y;
      }
    return to > from ? integral / (to - from) : y;
  }

  Peak peak_of_running_mean(const HistoryTable &table, const std::string &name, const double width)
  {
    Peak peak{-std::numeric_limits<double>::infinity(), 0};
    for (const double strain : column(table, "axial_strain"))
      if (strain >= width * (1 - 1e-9))
        {
          const double mean = mean_over_strain(table, name, strain - width, strain);
          if (mean > peak.value)
            peak = {mean, strain};
        }
    return peak;
  }

  double median(std::vector<double> values)
  {
    if (values.empty())
      return std::numeric_limits<double>::quiet_NaN();
    const auto middle = values.begin() + values.size() / 2;
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  }
} // namespace diptych::coupling
