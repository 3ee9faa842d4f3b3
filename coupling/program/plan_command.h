// diptych: plan SCENE: what a scene needs for an accuracy
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/program/command_line.h"

namespace diptych::coupling
{
  // Pilot runs in DIR/runs, plan.json and planned.prm; with --run the planned samples, too.
  int make_plan(const CommandLine &line);
} // namespace diptych::coupling
