// diptych: the paths of a calibration, and how the continuum is run on them
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
  // A path with what its samples show.
  struct CalibrationPath
  {
    const CalibrationTarget &target;
    Scene                    scene;
    TargetData               data;
    std::vector<Observation> samples;  // one a seed
    std::vector<std::string> left_out; // why, one entry an observable; empty: it counts
  };

  enum class ModelMesh
  {
    coarse, // a rectangle with large elements
    fine    // the sample's own
  };

  struct ModelRun
  {
    Observation observation;
    std::string words; // why there is none; empty: it finished
  };

  struct ModelTask
  {
    std::vector<std::size_t>           paths;
    std::vector<std::vector<Settings>> points; // [point][path]
    ModelMesh                          mesh      = ModelMesh::coarse;
    double                             load_step = 0;
  };

  // The continuum's runs of a task: [point][path]. May throw, which ends the calibration; the record holds what was found.
  using RunModel = std::function<std::vector<std::vector<ModelRun>>(const ModelTask &)>;
} // namespace diptych::coupling
