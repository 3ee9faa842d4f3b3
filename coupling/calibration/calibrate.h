// diptych: the continuum's parameters from the grains' curves
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "coupling/calibration/calibration.h"
#include "coupling/calibration/calibration_record.h"
#include "coupling/calibration/coordinates.h"
#include "coupling/calibration/model_runs.h"

namespace diptych::coupling
{
  // Several starts on coarse meshes, then the samples' own with the coarse Jacobian; then what the data tell and do not tell,
  // what load steps half as long change, and what is predicted on the paths that were not fitted. `on_best`: told of every better
  // point, with the chi^2 so far. Throws std::invalid_argument where no start has a run.
  void calibrate(const Calibration                  &calibration,
                 const Coordinates                  &coordinates,
                 const std::vector<CalibrationPath> &paths,
                 const RunModel                     &run,
                 CalibrationRecord                  &record);
} // namespace diptych::coupling
