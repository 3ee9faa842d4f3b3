// diptych: columns of a history, and means over a range of progress
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/statistics/history_table.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace diptych::coupling
{
  namespace
  {
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

  const std::vector<double> &column(const HistoryTable &table, const std::string_view name)
  {
    const auto found = table.find(name);
    if (found == table.end())
      throw std::invalid_argument("the history has no column '" + std::string(name) + "'");
    return found->second;
  }

  double mean_over_progress(const HistoryTable &table, const std::string &name, const double from, const double to)
  {
    const std::vector<double> &xs = column(table, "progress"), &ys = column(table, name);
    double                     integral = 0, x = from, y = interpolate(xs, ys, from);
    for (std::size_t k = std::upper_bound(xs.begin(), xs.end(), from) - xs.begin(); x < to; ++k)
      {
        const double next_x = k < xs.size() ? std::min(xs[k], to) : to, next_y = interpolate(xs, ys, next_x);
        integral += 0.5 * (y + next_y) * (next_x - x);
        x = next_x;
        y = next_y;
      }
    return to > from ? integral / (to - from) : y;
  }

  double ratio_of_means(const HistoryTable &table, const double from, const double to)
  {
    const std::vector<double> &progress = column(table, "progress"), &xx = column(table, "sxx"), &xy = column(table, "sxy"),
                              &yy = column(table, "syy"), &yx = table.count("syx") > 0 ? column(table, "syx") : xy;
    if (!(to > from) || progress.empty() || is_beyond(to, progress.back()))
      return std::numeric_limits<double>::quiet_NaN();
    std::vector<double> t, s;
    for (std::size_t k = 0; k < progress.size(); ++k)
      {
        t.push_back(std::hypot(0.5 * (xx[k] - yy[k]), 0.5 * (xy[k] + yx[k])));
        s.push_back(0.5 * (xx[k] + yy[k]));
      }
    const HistoryTable stress{{"progress", progress}, {"t", std::move(t)}, {"s", std::move(s)}};
    return mean_over_progress(stress, "t", from, to) / mean_over_progress(stress, "s", from, to);
  }

  std::vector<double> running_mean(const HistoryTable &table, const std::string &name, const double width)
  {
    const std::vector<double> &x = column(table, "progress"), &y = column(table, name);
    std::vector<double>        integral(x.size(), 0.); // from the first row
    for (std::size_t k = 1; k < x.size(); ++k)
      integral[k] = integral[k - 1] + 0.5 * (y[k - 1] + y[k]) * (x[k] - x[k - 1]);
    const auto up_to = [&](const double at) {
      if (at <= x.front())
        return y.front() * (at - x.front());
      const std::size_t k = std::size_t(std::upper_bound(x.begin(), x.end(), at) - x.begin()) - 1;
      return integral[k] + 0.5 * (y[k] + interpolate(x, y, at)) * (at - x[k]);
    };
    std::vector<double> mean(x.size(), std::numeric_limits<double>::quiet_NaN());
    for (std::size_t k = 0; k < x.size(); ++k)
      if (x[k] >= width * (1 - 1e-9))
        mean[k] = (integral[k] - up_to(x[k] - width)) / width;
    return mean;
  }

  Peak peak_of_running_mean(const HistoryTable &table, const std::string &name, const double width)
  {
    const std::vector<double> mean = running_mean(table, name, width), &progress = column(table, "progress");
    Peak                      peak;
    for (std::size_t k = 0; k < mean.size(); ++k)
      if (!std::isnan(mean[k]) && !(mean[k] <= peak.value))
        peak = {mean[k], progress[k]};
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
