// diptych: what a run will take of the machine
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
    int  samples = 1; // of an ensemble: results of all, memory of one
  };

  struct CpuRange
  {
    double low = 0, high = 0;
  };

  // What a run is expected to take, by what runs of this program took (resource_estimate.cc). 0 where it is not known beforehand:
  // of what stands in a file (sample, mesh) and of steps that nothing presses. refinement = adaptive: as if every element were
  // divided; only the low end of the CPU time is that of the first mesh.
  struct ResourceEstimate
  {
    double   steps = 0, load_steps = 0; // of the grains and of the continuum, of one sample
    double   memory = 0, disk = 0;      // [bytes]
    CpuRange cpu_s;                     // of the panels [s]
  };
  ResourceEstimate estimate_resources(const Scene &scene, const RunParts &parts);

  // Throws std::runtime_error naming what is asked for and what there is, where the machine has not the memory, or the disk of
  // the result folder not the room. refinement = adaptive: for the first mesh.
  void require_resources(const Scene &scene, const RunParts &parts);

  // "2000 grains, 647 steps; about 10.1 MB of memory, 30.8 MB of files, 3 s to 10 s of CPU time": what is known of it.
  std::string resource_text(const Scene &scene, const RunParts &parts);

  // Both, at the beginning of a command; a run that goes on needs less, so no text then.
  void announce_resources(const CommandLine &line, const Scene &scene, const RunParts &parts);
} // namespace diptych::coupling
