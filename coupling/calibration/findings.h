// diptych: the findings of a calibration, put down
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/calibration/calibration_record.h"
#include "coupling/calibration/coordinates.h"
#include "coupling/calibration/identification.h"
#include "coupling/calibration/model_runs.h"

namespace diptych::coupling
{
  // Values with their intervals, correlations, and in words what is not identified or lies at its bound.
  void tell_parameters(const Coordinates     &coordinates,
                       const Identification  &knowledge,
                       const Eigen::VectorXd &point,
                       CalibrationRecord     &record);

  // The continuum on one path: with the scene's own parameters, with the calibrated ones, and these with load steps half as long.
  struct PathRuns
  {
    const NoiseModel &noise;
    const ModelRun   &before, &after, &halved;
  };
  // Where the law misses the data by more than a right one would.
  void tell_misfit(CalibrationRecord &record);

  // Predictions of a path that was not fitted: the deviation of the parameters goes into the intervals and verdicts, with
  // this 97.5 % quantile. The angle has none: the data of the fit hold no derivative of it.
  void add_parameters_to_predictions(double quantile, PathRecord &record);

  PathRecord path_record(const CalibrationPath &path, const PathRuns &runs);
} // namespace diptych::coupling
