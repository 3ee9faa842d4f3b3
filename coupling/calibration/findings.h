// diptych: turns the results of a fit into records and findings
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/calibration/calibration_record.h"
#include "coupling/calibration/coordinates.h"
#include "coupling/calibration/identification.h"
#include "coupling/calibration/model_runs.h"

namespace diptych::coupling
{
  // Adds values with intervals and correlations, and findings on parameters that are not identified or lie at a bound.
  void tell_parameters(const Coordinates     &coordinates,
                       const Identification  &knowledge,
                       const Eigen::VectorXd &point,
                       CalibrationRecord     &record);

  // The continuum on one path: before the calibration, calibrated, and calibrated with load steps half as long.
  struct PathRuns
  {
    const NoiseModel &noise;
    const ModelRun   &before, &after, &halved;
  };
  // Adds a finding if the law misses the data by more than expected.
  void tell_misfit(CalibrationRecord &record);

  // Widens the predictions of a path that was not fitted by the deviation of the parameters, with this 97.5 % quantile. The
  // angle is not widened, because the fit has no derivative of it.
  void add_parameters_to_predictions(double quantile, PathRecord &record);

  PathRecord path_record(const CalibrationPath &path, const PathRuns &runs);
} // namespace diptych::coupling
