// diptych: makes a snapshot of the state of a loading
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "discrete/panel/history.h"
#include "discrete/snapshot.h"
#include "discrete/panel/window_forces.h"

namespace diptych::discrete
{
  // `result` belongs to the step that led to the state. `window` sums the steps since the preceding snapshot; it may be empty.
  Snapshot make_snapshot(const State        &state,
                         const StepResult   &result,
                         const WindowForces &window,
                         const Reference    &reference,
                         const StepSetting  &setting);
} // namespace diptych::discrete
