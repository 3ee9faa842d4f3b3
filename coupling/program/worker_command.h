// diptych: a process that runs one command after another for its parent
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <string>

#include "coupling/program/command_line.h"

namespace diptych::coupling
{
  // The only word of a worker's command line.
  inline constexpr char worker_word[] = "--worker";

  // Reads tasks from standard input until it ends: lines of JSON, {"words": the command line, "log": a file}. Appends the output
  // and the errors of each task to its log and answers with its exit code on a line. `execute` carries a command line out.
  int work_for_parent(const std::function<int(const CommandLine &)> &execute);
} // namespace diptych::coupling
