// diptych: a quantity given at some times
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace diptych::discrete
{
  // Values at ascending times: linear in between, constant before the first and after the last.
  template <class Value> struct TableOf
  {
    std::vector<double> time;
    std::vector<Value>  value;

    Value at(const double t) const
    {
      if (t <= time.front())
        return value.front();
      if (t >= time.back())
        return value.back();
      const std::size_t k = std::size_t(std::upper_bound(time.begin(), time.end(), t) - time.begin());
      return value[k - 1] + (value[k] - value[k - 1]) * (t - time[k - 1]) / (time[k] - time[k - 1]);
    }
  };
  using TimeTable = TableOf<double>;
} // namespace diptych::discrete
