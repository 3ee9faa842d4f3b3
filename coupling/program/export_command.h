// diptych: export FOLDER: our prepared sample as a start for other codes
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/program/command_line.h"

namespace diptych::coupling
{
  // Returns an ExitCode. Throws SceneError if the folder has no such snapshot.
  int export_sample(const CommandLine &line);
} // namespace diptych::coupling
