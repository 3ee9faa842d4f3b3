// diptych: converts another code's sample to results of the discrete panel
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>

#include "coupling/import/arrived_sample.h"
#include "coupling/store/results.h"

namespace diptych::coupling
{
  // One snapshot and one history row per frame; the first frame is the start of the loading. Unknown quantities are NaN. Throws
  // SceneError if the upper wall neither descends nor moves sideways steadily from frame to frame.
  DiscreteResults imported_results(const Arrival &arrival);

  // A scene that runs on these results: discrete/method = imported, with `file` beside it. Without `pressure` it takes that of
  // the side walls in the first frame with contacts. Throws SceneError if there are neither side walls nor a pressure.
  std::string imported_scene(const Arrival &arrival, const DiscreteResults &results, const std::optional<double> &pressure);
} // namespace diptych::coupling
