// diptych: import FORMAT FILES: other codes' samples as results of the discrete panel
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/program/command_line.h"

namespace diptych::coupling
{
  // Exit code. Throws SceneError for wrong files, before anything is written.
  int import_sample(const CommandLine &line);
} // namespace diptych::coupling
