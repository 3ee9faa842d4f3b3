// diptych: estimate of the memory, disk space and CPU time of a run
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "coupling/program/command_line.h"
#include "coupling/scene/scene.h"

namespace diptych::coupling
{
  struct RunParts
  {
    bool grains = false, continuum = false;
    int  samples = 1; // of an ensemble: files count for all samples, memory for one
  };

  struct CpuRange
  {
    double low = 0, high = 0;
  };

  // Expected cost of a run, from measured runs (resource_estimate.cc). A number is 0 if it is not known beforehand: for a sample
  // or mesh from a file, and for steps without pressure. With refinement = adaptive the estimate assumes that every element is
  // divided; only the low end of the CPU time belongs to the first mesh.
  struct ResourceEstimate
  {
    double   steps = 0, load_steps = 0; // steps of the grains, load steps of the continuum, for one sample
    double   memory = 0, disk = 0;      // [bytes]
    CpuRange cpu_s;                     // CPU time of the panels [s]
  };
  ResourceEstimate estimate_resources(const Scene &scene, const RunParts &parts);

  // Throws std::runtime_error with the needed and the available size if memory or disk space is too small. With refinement =
  // adaptive it checks for the first mesh. A continued run needs the disk space that its folder does not fill yet.
  void require_resources(const Scene &scene, const RunParts &parts, bool resume = false);

  // The known parts of "2000 grains, 647 steps; about 10.1 MB of memory, 30.8 MB of files, 3 s to 10 s of CPU time".
  std::string resource_text(const Scene &scene, const RunParts &parts);

  // Calls require_resources(), and prints resource_text() unless the run is continued.
  void announce_resources(const CommandLine &line, const Scene &scene, const RunParts &parts);
} // namespace diptych::coupling
