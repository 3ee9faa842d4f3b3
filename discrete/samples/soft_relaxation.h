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
    double largest_overlap = 0;     // remaining [length]
    bool   stopped         = false; // go_on returned false; the relaxation is incomplete
  };

  // Minimises the elastic energy (1/2) sum overlap^2 of discs and walls by FIRE (Bitzek et al. 2006). Ends if no overlap exceeds
  // `largest_overlap` [length], `max_iterations` are done, or `go_on`, called before each iteration, returns false. Changes only
  // positions.
  RelaxationReport relax_soft_discs(State                       &state,
                                    double                       largest_overlap,
                                    int                          max_iterations,
                                    const std::function<bool()> &go_on = {});
} // namespace diptych::discrete
