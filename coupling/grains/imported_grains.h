// diptych: frames of another code as the grains of a run
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "coupling/processes/run_options.h"
#include "coupling/scene/scene.h"
#include "coupling/store/results.h"
#include "discrete/bodies/state.h"

namespace diptych::coupling
{
  // Reads discrete.h5, discrete.csv and the facts of an import. Throws SceneError with key and file if one is missing or
  // damaged. The stages may differ from the scene's, which replace them, by a thousandth.
  DiscreteResults load_imported(const Scene &scene);

  // Motion of the walls over the progress (the tables' time), linear between frames.
  struct ImportedWalls
  {
    double              initial_height = 0;
    discrete::TimeTable upper_x, upper_y; // displacement of the upper platen [length]
    discrete::TimeTable right_x,
      right_pressure; // right wall: outward displacement, pressure on the sample; may be empty
  };
  ImportedWalls imported_walls(const DiscreteResults &results);

  // Copies the frames of discrete/file into the result folder, which is then independent of the imported folder.
  void take_imported(const RunOptions &options, const Scene &scene);
} // namespace diptych::coupling
