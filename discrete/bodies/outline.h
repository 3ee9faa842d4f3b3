// diptych: outline of the grain sample between its platens
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "discrete/snapshot.h"
#include "discrete/bodies/state.h"

namespace diptych::discrete
{
  // Lateral envelopes between walls[0] and walls[1]. Horizontal lines 0.1 d apart give the outermost disc surfaces. These are
  // smoothed by a Gauss kernel (standard deviation 1 d, end values extended) and then sampled about every 2 d. With side walls
  // the outline is the walls. For a periodic sample it is a rectangle of one period about the mean abscissa of the grains, in a
  // lattice its parallelogram about their mean position. Both sides run from the lower platen to the upper one.
  Outline make_outline(const State &state, double mean_diameter);

  double outline_area(const Outline &outline);
  double outline_area(const Outline &outline, double low, double high); // between two heights
} // namespace diptych::discrete
