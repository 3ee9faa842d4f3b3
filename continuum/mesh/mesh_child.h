// diptych: gmsh in a process of its own, so that nothing that it does ends the run
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <stdexcept>

#include "continuum/mesh/quad_mesh.h"

namespace diptych::continuum
{
  // gmsh crashed, ended the process or took longer than it may.
  struct GmshEnded : std::runtime_error
  {
    using std::runtime_error::runtime_error;
  };

  // The mesh that `make` returns. It is called in a copy of this process (fork) that ends with it; what it throws is thrown here:
  // std::invalid_argument as such, everything else as std::runtime_error. Throws GmshEnded where the copy ends otherwise (a
  // crash, an exit within gmsh, more than `most_cpu_seconds` or three times as many on the clock), MeshingStopped once
  // `stop_requested` says so. `most_cpu_seconds` is 0 for work of our own, which has no limit; with a limit it is a user's, which
  // moreover writes no file and starts no program (no_programs.h). What reads the standard input finds its end.
  QuadMesh made_in_child(const std::function<QuadMesh()> &make,
                         const std::function<bool()>     &stop_requested,
                         unsigned int                     most_cpu_seconds = 0);
} // namespace diptych::continuum
