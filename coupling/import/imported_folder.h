// diptych: uses an imported sample as results of the discrete panel
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "coupling/scene/scene.h"
#include "coupling/store/results.h"
#include "discrete/bodies/state.h"

namespace diptych::coupling
{
  // The name in discrete/file with {seed} replaced.
  std::string imported_file(std::string file, int seed);

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
} // namespace diptych::coupling
