// diptych: what the preparation of a sample gives
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "discrete/stepping/time_stepping.h"

namespace diptych::discrete
{
  // Largest overlap that may remain between the grains of a prepared sample. [mean diameters]
  inline constexpr double largest_prepared_overlap = 1e-4;

  struct PreparationReport
  {
    bool   quiet    = false;
    int    steps    = 0;
    double residual = 0, unbalanced_force = 0; // of the last step
    double solid_fraction  = 0;                // grain area / sample area
    double soft_overlap    = 0;                // largest overlap left by the soft discs [length]
    int    settling_steps  = 0;                // steps from rest, after `steps`, that removed the overlaps
    double largest_overlap = 0;                // between grains and with walls, at the end [mean diameters]
    double friction        = 0;                // of the preparation
    double evenness        = 1;                // of the pressure in a large sample (samples/uniform_strain.h)
    double stress_error    = 0;                // of a large sample against its sides, relative
    bool   touches         = true;             // false: after `steps` under pressure no contact carries a force
  };

  struct PreparedSample
  {
    State state; // at rest (from a file: with its velocities); walls[0] and walls[1] are the platens, unless there is a lattice
    StepResult        last_step; // contacts and impulses of the sample
    double            step = 0;  // length of that step
    PreparationReport report;
  };
} // namespace diptych::discrete
