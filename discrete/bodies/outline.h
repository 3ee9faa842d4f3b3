// diptych: outline of the grain sample between its platens
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "discrete/snapshot.h"
#include "discrete/bodies/state.h"

namespace diptych::discrete
{
  // Lateral envelopes between walls[0] and walls[1]: at each of a set of heights 0.1 d apart the outermost disc surface met
  // by a horizontal line, smoothed by a Gauss kernel (standard deviation 1 d, ends extended evenly), then sampled about
  // every 2 d. Between side walls the walls themselves; of a periodic sample a rectangle one period wide about the grains' mean
  // abscissa. Both sides run from the lower platen to the upper one.
  Outline make_outline(const State &state, double mean_diameter);

  double outline_area(const Outline &outline);
} // namespace diptych::discrete
