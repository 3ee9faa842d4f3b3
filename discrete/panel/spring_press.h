// diptych: the springs of the penalty method take up the pressure before the loading
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>

#include "discrete/panel/loading.h"
#include "discrete/stepping/penalty.h"

namespace diptych::discrete
{
  // A sample of rigid grains has no overlap to press with: loaded at once, soft springs would be squeezed together during the
  // loading, and what overlaps would be flung apart.
  struct SpringPress
  {
    const PenaltyOptions &penalty;
    const LoadingStart   &start;   // the sides act as it says, the platens rest; drives of its own are left out
    StepSetting           setting; // its friction is that of the loading
    double                density; // of the grains
  };

  // Steps for penalty_preload under penalty_preload_friction. What the state was pressed with, its length of step included; ends
  // early where the springs blow up, as `last_step.solve` tells. Nothing where `go_on`, asked with the share done, says no.
  struct PressedSample
  {
    StepResult last_step;
    double     step = 0;
  };
  std::optional<PressedSample> press_springs(State &state, SpringPress press, const std::function<bool(double)> &go_on);
} // namespace diptych::discrete
