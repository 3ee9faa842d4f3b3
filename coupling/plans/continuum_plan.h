// diptych: plans elements, load steps, tolerance, law and geometry of the continuum
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/plans/plan.h"
#include "coupling/scene/scene.h"

namespace diptych::coupling
{
  // Starts from coarse elements and long load steps and halves one size after the other, until the estimated error
  // (error_law.h) is within its share of the accuracy. Then takes the largest size that the share allows. Cheaper models (small
  // strain, a law without an internal length, simpler elements) are used if they change the results by less than their share.
  // If the results of a law without an internal length keep changing with the elements, its Cosserat counterpart replaces it,
  // and the plan reports this.
  PanelPlan plan_continuum(const PlanQuestion &question, const Scene &scene, const RunPilot &run);
} // namespace diptych::coupling
