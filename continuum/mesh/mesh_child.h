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

  // Calls `make` in a child process (fork) and returns its mesh. Exceptions of `make` are thrown again here:
  // std::invalid_argument as such, all others as std::runtime_error. `most_cpu_seconds` limits the CPU time of the child; 0 sets
  // no limit. The child's standard input is empty and its output is dropped. Throws GmshEnded if the child crashed, exited or
  // exceeded its limit (three times as many seconds of wall time count, too). Calls `check_stop` every 50 ms; if that throws, the
  // child is killed and the exception passes on.
  QuadMesh made_in_child(const std::function<QuadMesh()> &make, const CheckStop &check_stop, unsigned int most_cpu_seconds = 0);
} // namespace diptych::continuum
