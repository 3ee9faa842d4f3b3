// diptych: profiles of both panels across their bands
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

#include "coupling/comparison/increment.h"
#include "coupling/scene/scene.h"

namespace diptych::coupling
{
  // Adds the profile of each panel across its strongest band; across the other panel's if it has none, no profile if neither has.
  // Both panels are averaged directly onto strips one mean diameter thick, by the scene's averaging method: 41 strips around the
  // band, cut into blocks of at least probe_block along it. A block counts if it lies two diameters inside the sample. Couple
  // stress is the mean over the stage that ends with the increment. A classical continuum has no rotation and no couple stress,
  // and no continuum has fluctuations: NaN. Its solid fraction is start_solid_fraction times its initial over its present volume.
  void add_profiles(const StagePair         &pair,
                    const ComparisonOptions &options,
                    double                   start_solid_fraction,
                    std::uint64_t            seed,
                    Increment               &increment);
} // namespace diptych::coupling
