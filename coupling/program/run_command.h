// diptych: run SCENE: both panels, homogenisation, comparison, report
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/program/command_line.h"

namespace diptych::coupling
{
  int run_both(const CommandLine &line);
} // namespace diptych::coupling
