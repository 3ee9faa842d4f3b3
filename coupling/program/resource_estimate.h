// diptych: estimate of the memory, disk space and CPU time of a run
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/program/command_line.h"
#include "coupling/scene/scene.h"

namespace diptych::coupling
{
  struct RunParts
  {
    bool grains = false, continuum = false;
    int  samples   = 1; // of an ensemble: files and time count for all samples, memory for one
    int  processes = 1; // of each sample: time counts for all processes, memory for one
  };

  // Without the sizes of samples and meshes from files. With refinement = adaptive for the first mesh.
  struct ResourceEstimate
  {
    double      memory = 0, disk = 0; // [bytes]
    double      cpu_s = 0;            // of all processes and samples
    std::string text; // "2000 grains, 647 steps; about 10.1 MB of memory, 30.8 MB of files, 3 s to 12 s of CPU time"
  };
  ResourceEstimate estimate_resources(const Scene &scene, const RunParts &parts);

  // Prints the text. Throws std::runtime_error if memory or disk has less than half of the estimate. A continued run fits.
  void announce_resources(const CommandLine &line, const Scene &scene, const RunParts &parts);
} // namespace diptych::coupling
