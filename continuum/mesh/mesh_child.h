// diptych: gmsh in a child process, so that a crash or an exit in gmsh does not end the run
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <stdexcept>

#include "continuum/mesh/quad_mesh.h"
#include "continuum/stopping.h"

namespace diptych::continuum
{
  // gmsh crashed, ended the process or took longer than it may.
  struct GmshEnded : std::runtime_error
  {
    using std::runtime_error::runtime_error;
  };

  // Calls `make` in a child process (fork) with empty input and dropped output, and returns its mesh. Rethrows
  // std::invalid_argument from `make`; other exceptions become std::runtime_error. `most_cpu_seconds` limits the
  // CPU time of the child, and three times as many seconds its wall time; 0 sets no limit. Throws GmshEnded if the child
  // crashed, exited or exceeded a limit. Calls `check_stop` every 50 ms; if that throws, the child is killed and the exception
  // passes on.
  QuadMesh made_in_child(const std::function<QuadMesh()> &make, const CheckStop &check_stop, unsigned int most_cpu_seconds = 0);
} // namespace diptych::continuum
