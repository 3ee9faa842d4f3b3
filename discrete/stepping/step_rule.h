// diptych: the length of a step, from forces and motion
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "discrete/stepping/time_stepping.h"

namespace diptych::discrete
{
  // The bounds of the rule and what they gave. d: mean diameter, rho: grain density.
  struct StepChoice
  {
    double      step;  // the smallest bound [time]
    std::string bound; // which one: "forces", "motion", "drives", "gravity" or "solver"
  };

  // step = auto (Moreau 1997: from the forces where grains are pressed together, from the speeds where they fly):
  //   forces   1 d sqrt(rho/s) with free end grains, 5 otherwise; s the larger of pressure and present mean stress
  //   motion   0.1 d / V, V the speed of the fastest wall or, if larger, three times the root mean square of the grains'
  //   drives   0.1 of the shortest interval of a wall's table; sqrt(0.1 d M/F) of a wall of mass M under a force F; the largest
  //            speed of a table counts among the speeds of walls
  //   gravity  0.3 sqrt(d/g)
  //   solver   0.6 I / tolerance in units of d sqrt(rho/s): solver noise stays below the grains' own motion (rate > 0 only)
  // `mean_stress` s [pressure], 0 where nothing is pressed; `rate`: strain rate, 0 where there is none.
  StepChoice choose_step(const State &state, const StepSetting &setting, double mean_stress, double rate);
} // namespace diptych::discrete
