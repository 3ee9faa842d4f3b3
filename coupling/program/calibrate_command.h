// diptych: calibrate CALIBRATION.json: the continuum's parameters from the grains' curves
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/program/command_line.h"

namespace diptych::coupling
{
  int run_calibration(const CommandLine &line);
} // namespace diptych::coupling
