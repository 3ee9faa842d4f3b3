// diptych: quantiles of Student's distribution
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <boost/math/distributions/students_t.hpp>

namespace diptych::coupling
{
  constexpr double normal_quantile = 1.959963984540054; // 97.5 %, for a known standard deviation

  // probability in (0, 1); degrees_of_freedom above 0, not necessarily whole.
  [[nodiscard]] inline double student_quantile(const double probability, const double degrees_of_freedom)
  {
    return boost::math::quantile(boost::math::students_t(degrees_of_freedom), probability);
  }
} // namespace diptych::coupling
