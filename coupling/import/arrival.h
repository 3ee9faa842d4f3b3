// diptych: another code's sample put in order and checked
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/import/arrived_sample.h"

namespace diptych::coupling
{
  // Throws SceneError naming file, line and what is impossible: contacts to nobody, grains that stand twice or are in one frame
  // and not in another, pairs with two forces, walls that cannot be told from each other, spheres without a thickness.
  Arrival arrive(ForeignSample sample, const ForeignOptions &options);
} // namespace diptych::coupling
