// diptych: what a run will take of the machine
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/scene/scene.h"

namespace diptych::coupling
{
  struct RunParts
  {
    bool grains = false, continuum = false;
    int  samples = 1; // of an ensemble: results of all, memory of one
  };

  // Bytes that a run is expected to take, by what runs of this program took (run_room.cc); 0 where it is not known beforehand.
  struct RunRoom
  {
    double memory = 0, disk = 0;
  };
  RunRoom expected_room(const Scene &scene, const RunParts &parts);

  // Throws std::runtime_error naming what is asked for and what there is, where the machine has not the memory, or the disk of
  // the result folder not the room.
  void demand_room(const Scene &scene, const RunParts &parts);
} // namespace diptych::coupling
