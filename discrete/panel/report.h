// diptych: report of the preparation and loading of a sample
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <limits>
#include <string>

#include "discrete/stepping/grain_stress_error.h"
#include "discrete/samples/sample_preparation.h"
#include "discrete/stepping/step_rule.h"

namespace diptych::discrete
{
  enum class Status
  {
    finished,
    stopped_by_user,
    not_converged
  };

  struct Report
  {
    Status            status       = Status::finished;
    double            progress     = 0;                   // reached value of the loading variable
    double            axial_strain = 0, shear_strain = 0; // reached
    std::string       message;                            // empty if finished
    PreparationReport preparation;
    double            step = 0;                                             // of the last stage
    std::string       step_bound;                                           // step = auto: the bound that gave the step
    double            tolerance = std::numeric_limits<double>::quiet_NaN(); // of the last stage
    ExpectedErrors    expected;                                             // due to step and tolerance; largest of all stages
    long              steps = 0, sweeps = 0, updates = 0; // of the loading; one update = one contact in one sweep
    double            preparation_cpu_s = 0, loading_cpu_s = 0, solver_cpu_s = 0;
    double            initial_height = 0, platen_speed = 0; // speed: strain rate x height

    // (Error of the grain stress) / residual, measured at one step per run against a more accurate solution of this step.
    double error_over_residual = std::numeric_limits<double>::quiet_NaN();
    double reference_residual  = error_over_residual; // residual of the more accurate solution
    double reference_error     = error_over_residual; // error measured against it
    double estimated_error     = error_over_residual; // estimate of the same error

    int snapshots_sampled = 0, snapshots_accurate = 0;
    int halved_steps = 0; // because the sweeps stalled
  };

  void note(Report &report, const SampledAccuracy &accuracy);
  void note(Report &report, const ExpectedErrors &errors); // keeps the largest of all stages
} // namespace diptych::discrete
