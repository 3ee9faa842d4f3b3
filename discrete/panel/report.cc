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
    report.expected.strength       = std::max(report.expected.strength, errors.strength);
    report.expected.dilation_loss  = std::max(report.expected.dilation_loss, errors.dilation_loss);
    report.expected_dilation_error = report.expected.dilation();
  }

  void note_costs(Report &report)
  {
    report.ns_per_update       = report.updates > 0 ? 1e9 * report.solver_cpu_s / double(report.updates) : 0;
    report.solver_share_of_cpu = report.loading_cpu_s > 0 ? report.solver_cpu_s / report.loading_cpu_s : 0;
  }
} // namespace diptych::discrete
