// diptych: preload of the springs of penalty and compliant before the loading
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>

#include "discrete/panel/loading.h"
#include "discrete/samples/sample_preparation.h"
#include "discrete/stepping/penalty.h"

namespace diptych::discrete
{
  // Rigid grains have no overlap that could carry the pressure. Without a preload, soft springs would be compressed during the
  // loading, and overlapping grains would be pushed apart.
  struct SpringPress
  {
    const PenaltyOptions &penalty;
    const LoadingStart   &start;    // sets the sides; its wall drives are ignored
    StepSetting           setting;  // with the friction of the loading
    double                density;  // of the grains
    const PreparedSample &prepared; // a path keeps its isotropic pressure, and a platen its force; in a file platens rest

    std::shared_ptr<ThreadTeam> team;
  };

  // Explicit steps for the time penalty_preload with penalty_preload_friction, or implicit ones with the friction of the loading,
  // until the sample is at rest, at most for that time. Returns the last step and its length. Ends early if the springs blow up,
  // see `last_step.solve`. Returns nothing if `go_on`, called with the finished share, returns false.
  struct PressedSample
  {
    StepResult last_step;
    double     step = 0;
  };
  std::optional<PressedSample> press_springs(State &state, SpringPress press, const std::function<bool(double)> &go_on);
} // namespace diptych::discrete
