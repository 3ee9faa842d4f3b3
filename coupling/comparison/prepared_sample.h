// diptych: checks of the prepared sample that a comparison needs, made before anything runs
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/probes/probe_options.h"
#include "discrete/snapshot.h"

namespace diptych::coupling
{
  // Throws SceneError for too few grains for the band detection, or a probe of the scene outside the prepared sample. A band or
  // probe that leaves the sample during the loading is found only by the comparison.
  void require_comparable_sample(const ProbeOptions &options, const discrete::Snapshot &prepared);
} // namespace diptych::coupling
