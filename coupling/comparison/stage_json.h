// diptych: what is compared at one instant, as JSON
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "coupling/comparison/comparison.h"

namespace diptych::coupling
{
  // Lengths in mean diameters d where the name ends in _d, else in the scene's unit; NaN becomes null.
  nlohmann::json stage_json(const StageRecord &stage, double d, const std::string &averaging_method);
  nlohmann::json window_json(const Increment &window, double d);
  nlohmann::json resolution_json(const ResolutionStudy &study);

  // Of one panel's increment: bands alone.
  nlohmann::json bands_json(const BandReport &report, double d);
} // namespace diptych::coupling
