// diptych: Python binding of whole runs, for the workers of campaigns
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <map>
#include <string>

#include <pybind11/pybind11.h>

#include "coupling/program/command_line.h"

namespace diptych::python
{
  struct RunnableCommand
  {
    coupling::Command command;
    int (*run)(const coupling::CommandLine &line, const coupling::Scene &scene);
  };

  // Binds run() for these commands and become_worker(), which calls `begin`.
  void bind_runs(
    pybind11::module_                            &m,
    const std::map<std::string, RunnableCommand> &commands,
    void (*begin)() = [] {});
} // namespace diptych::python
