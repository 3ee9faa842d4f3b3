// diptych: fits order of convergence and limit to results at several sizes
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <vector>

namespace diptych::coupling
{
  // value = limit + coefficient h^order
  struct ConvergenceFit
  {
    double limit = 0, coefficient = 0, order = 0;
  };

  // Least squares over orders from 1/4 to 6, for at least three different h > 0. Returns nothing if the values follow no power
  // law: the best order lies at an end of the range, the rms residual exceeds a twentieth of the values' range, or all values
  // are equal. Source: Roache, J. Fluids Eng. 116 (1994) 405: the order is to be observed, not assumed.
  [[nodiscard]] std::optional<ConvergenceFit> fit_convergence(const std::vector<double> &h, const std::vector<double> &values);
} // namespace diptych::coupling
