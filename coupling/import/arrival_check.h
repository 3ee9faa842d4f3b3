// diptych: checks of an imported sample
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/import/arrived_sample.h"

namespace diptych::coupling
{
  // Fills arrival.checks, one per frame, and arrival.doubtful. Throws SceneError if walls are in the wrong order.
  void check_arrival(Arrival &arrival);
} // namespace diptych::coupling
