// diptych: a number with its 95 % interval
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <limits>

namespace diptych::coupling
{
  // A value and the ends of its 95 % interval, all in the unit of the value. An unknown end is NaN (null in JSON). Normally low
  // <= value <= high. For angles low and high are unwrapped around the value and may leave its range.
  struct Interval
  {
    double value = std::numeric_limits<double>::quiet_NaN();
    double low   = std::numeric_limits<double>::quiet_NaN();
    double high  = std::numeric_limits<double>::quiet_NaN();
  };

  inline Interval times(const double factor, const Interval &interval)
  {
    return {factor * interval.value, factor * interval.low, factor * interval.high};
  }
} // namespace diptych::coupling
