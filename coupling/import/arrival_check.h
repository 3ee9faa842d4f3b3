// diptych: what a sample of another code is checked for on arrival
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/import/arrived_sample.h"

namespace diptych::coupling
{
  // Fills arrival.checks, one a frame, and arrival.doubtful. Throws SceneError where walls stand in the wrong order.
  void check_arrival(Arrival &arrival);
} // namespace diptych::coupling
