// diptych: another code's sample as results of the discrete panel
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>

#include "coupling/import/arrived_sample.h"
#include "coupling/store/results.h"

namespace diptych::coupling
{
  // Snapshots, one a frame, the first as the start of the loading; rows of the ledger at the frames. What was not told is NaN.
  // Throws SceneError where the upper wall neither descends nor travels steadily from frame to frame.
  DiscreteResults imported_results(const Arrival &arrival);

  // A scene that runs on them: discrete/method = imported, `file` beside it. `pressure`: none: that of the side walls in the
  // first frame that has contacts. Throws SceneError where there are no side walls and no pressure was given.
  std::string imported_scene(const Arrival &arrival, const DiscreteResults &results, const std::optional<double> &pressure);
} // namespace diptych::coupling
