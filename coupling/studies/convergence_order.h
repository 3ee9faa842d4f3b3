// diptych: the order at which a result converges, and to what
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

  // Least squares over orders from 1/4 to 6; from three different h > 0 on. Nothing where there is no power law to be seen: the
  // best order lies at an end of that range, more than a twentieth of the values' range is left over (rms), or they do not
  // differ. Source: Roache, J. Fluids Eng. 116 (1994) 405: the order is to be observed, not assumed.
  [[nodiscard]] std::optional<ConvergenceFit> fit_convergence(const std::vector<double> &h, const std::vector<double> &values);
} // namespace diptych::coupling
