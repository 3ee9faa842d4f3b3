// diptych: result files of a plan
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "coupling/plans/plan.h"

namespace diptych::coupling
{
  // Writes plan.json and planned.prm, the scene with the settings of all panels. Throws SceneError if settings contradict each
  // other, std::runtime_error if a file cannot be written.
  void write_plan(const std::string &directory, const PlanQuestion &question, const Plan &plan);
} // namespace diptych::coupling
