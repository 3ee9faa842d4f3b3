// diptych: the paths of a calibration, and the function that runs the continuum on them
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "coupling/calibration/calibration.h"
#include "coupling/calibration/noise.h"
#include "coupling/calibration/observation.h"

namespace diptych::coupling
{
  // A path with the observations of its samples.
  struct CalibrationPath
  {
    const CalibrationTarget &target;
    Scene                    scene;
    TargetData               data;
    std::vector<Observation> samples;  // one per seed
    std::vector<std::string> left_out; // one reason per observable; empty: it counts
  };

  enum class ModelMesh
  {
    coarse, // a rectangle with large elements
    fine    // the sample's own mesh
  };

  struct ModelRun
  {
    Observation observation;
    std::string words; // reason if the run did not finish
  };

  struct ModelTask
  {
    std::vector<std::size_t>           paths;
    std::vector<std::vector<Settings>> points; // [point][path]
    ModelMesh                          mesh      = ModelMesh::coarse;
    double                             load_step = 0;
  };

  // Runs the continuum for a task: [point][path]. An exception ends the calibration; the record keeps the best point so far.
  using RunModel = std::function<std::vector<std::vector<ModelRun>>(const ModelTask &)>;
} // namespace diptych::coupling
