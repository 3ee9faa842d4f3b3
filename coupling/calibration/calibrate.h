// diptych: fits parameters of the continuum to the curves of the grains
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "coupling/calibration/calibration.h"
#include "coupling/calibration/calibration_record.h"
#include "coupling/calibration/coordinates.h"
#include "coupling/calibration/model_runs.h"

namespace diptych::coupling
{
  // Searches from several starts on coarse meshes, then continues on the samples' own meshes with the coarse Jacobian.
  // Afterwards it computes deviations of the parameters, the effect of load steps half as long, and predictions on paths that
  // were not fitted. `record` always holds the best point so far. Throws std::invalid_argument if no start has a run.
  void calibrate(const Calibration                  &calibration,
                 const Coordinates                  &coordinates,
                 const std::vector<CalibrationPath> &paths,
                 const RunModel                     &run,
                 CalibrationRecord                  &record);
} // namespace diptych::coupling
