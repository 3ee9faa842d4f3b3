// diptych: study STUDY.json: many points of a scene, each on every sample
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/program/command_line.h"

namespace diptych::coupling
{
  int run_study(const CommandLine &line);
} // namespace diptych::coupling
