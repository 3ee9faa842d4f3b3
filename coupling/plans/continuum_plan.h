// diptych: elements, load steps, tolerance, law and geometry that the continuum needs
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/plans/plan.h"
#include "coupling/scene/scene.h"

namespace diptych::coupling
{
  // From coarse elements and long load steps on one knob after the other is halved until what the changes say of the error is
  // within its share of the accuracy (error_law.h); then the largest size is taken that the share allows. Cheaper models (small
  // strain, a law without an internal length, simpler elements) are taken where they move nothing by more than their share. A law
  // without an internal length whose results go on changing with the elements is replaced by the one with it, and that is said.
  PanelPlan plan_continuum(const PlanQuestion &question, const Scene &scene, const RunPilot &run);
} // namespace diptych::coupling
