// diptych: puts another code's sample in order and checks it
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/import/arrived_sample.h"

namespace diptych::coupling
{
  // Throws SceneError naming file, line and the contradiction: contacts of unknown bodies, repeated grains, grains that are
  // missing in a frame, pairs with two forces, walls that cannot be distinguished, spheres without a thickness.
  Arrival arrive(ForeignSample sample, const ForeignOptions &options);
} // namespace diptych::coupling
