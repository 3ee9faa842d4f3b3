// diptych: what a comparison asks of a sample, looked at before anything runs
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/scene/scene.h"
#include "discrete/snapshot.h"

namespace diptych::coupling
{
  // Throws SceneError where the prepared sample has too few grains for a band to be looked for, or where nothing of a probe that
  // the scene places lies in it. Band and probes that the loading takes out of the sample are found when they are compared.
  void require_comparable_sample(const Scene &scene, const discrete::Snapshot &prepared);
} // namespace diptych::coupling
