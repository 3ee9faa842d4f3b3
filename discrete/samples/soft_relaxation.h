// diptych: first packing without overlaps, by relaxation of soft discs
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>

#include "discrete/bodies/state.h"

namespace diptych::discrete
{
  struct RelaxationReport
  {
    int    iterations      = 0;
    double largest_overlap = 0;     // left over [length]
    bool   stopped         = false; // go_on said so; positions are somewhere on the way
  };

  // Minimises the elastic energy (1/2) sum overlap^2 of discs and walls by FIRE (Bitzek et al. 2006) until no overlap
  // exceeds `largest_overlap` [length] or `max_iterations` are done, or `go_on`, asked before each, says no. Only positions
  // change.
  RelaxationReport relax_soft_discs(State                       &state,
                                    double                       largest_overlap,
                                    int                          max_iterations,
                                    const std::function<bool()> &go_on = {});
} // namespace diptych::discrete
