// diptych: relative values and differences of a pilot's samples
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/plans/pilot_values.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "coupling/cells/principal_axes.h"

namespace diptych::coupling
{
  namespace
  {
    constexpr double unit_of_angles = 45;

    double unit_of(const StudyQuantity &quantity, const double mean)
    {
      return quantity.is_line ? unit_of_angles : std::abs(mean);
    }
  } // namespace

  PilotSummary summary_of(const StudyQuantity &quantity, const std::vector<double> &values)
  {
    std::vector<double> finite;
    std::copy_if(values.begin(), values.end(), std::back_inserter(finite),
                 [](const double value) { return std::isfinite(value); });
    const SampleStatistics s = quantity.is_line ? line_statistics(finite) : statistics(finite);
    return {s, s.deviation / unit_of(quantity, s.mean)};
  }

  SampleStatistics relative_difference(const StudyQuantity       &quantity,
                                       const std::vector<double> &values,
                                       const std::vector<double> &others)
  {
    std::vector<double> of_others, differences;
    for (std::size_t k = 0; k < std::min(values.size(), others.size()); ++k)
      if (std::isfinite(values[k]) && std::isfinite(others[k]))
        {
          of_others.push_back(others[k]);
          differences.push_back(quantity.is_line ? line_turn(values[k], others[k]) : values[k] - others[k]);
        }
    const double unit = unit_of(quantity, statistics(of_others).mean);
    for (double &difference : differences)
      difference /= unit;
    return statistics(differences);
  }
} // namespace diptych::coupling
