// diptych: counts, extremes and costs of a whole run, as JSON
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "coupling/comparison/comparison.h"

namespace diptych::coupling
{
  // provenance: what the panels said of themselves when they ran.
  nlohmann::json discrete_summary(const Scene &scene, const Comparison &c, const nlohmann::json &provenance);
  nlohmann::json continuum_summary(const Scene &scene, const Comparison &c, const nlohmann::json &provenance);

  // CPU seconds of every phase, peak memory [MB].
  nlohmann::json cost_json(const nlohmann::json &provenance);
} // namespace diptych::coupling
