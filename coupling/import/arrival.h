// diptych: puts another code's sample in order and checks it
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/import/arrived_sample.h"

namespace diptych::coupling
{
  // Throws SceneError with file, line and contradiction. Grains: repeated, missing in a frame, spheres without a thickness.
  // Contacts: unknown bodies, pairs with two forces. Walls: not to be distinguished.
  Arrival arrive(ForeignSample sample, const ForeignOptions &options);
} // namespace diptych::coupling
