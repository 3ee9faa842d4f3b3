// diptych: report of the preparation and loading of a sample
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/panel/report.h"

#include <algorithm>
#include <cmath>

namespace diptych::discrete
{
  void note(Report &report, const SampledAccuracy &accuracy)
  {
    ++report.snapshots_sampled;
    report.snapshots_accurate += accuracy.reached;
    if (std::isnan(accuracy.reference_residual))
      return;
    report.error_over_residual = accuracy.error_over_residual;
    report.reference_residual  = accuracy.reference_residual;
    report.reference_error     = accuracy.true_error;
    report.estimated_error     = accuracy.stress_error;
  }

  void note(Report &report, const ExpectedErrors &errors)
  {
    report.expected.strength      = std::max(report.expected.strength, errors.strength);
    report.expected.dilation_loss = std::max(report.expected.dilation_loss, errors.dilation_loss);
  }
} // namespace diptych::discrete
