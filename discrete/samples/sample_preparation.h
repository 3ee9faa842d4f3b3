// diptych: a grain sample between two platens, ready to be loaded
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <string>

#include "discrete/samples/sample_options.h"
#include "discrete/stepping/time_stepping.h"

namespace diptych::discrete
{
  // Largest overlap that may remain between the grains of a prepared sample. [mean diameters]
  inline constexpr double largest_prepared_overlap = 1e-4;

  // Mean pressure of the grains / pressure on the sides. With less the middle of a sample is not loaded yet.
  inline constexpr double least_carried_share = 0.85;

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
    double carried_share   = 1;                // measured for more than 62500 grains
    bool   touches         = true;             // false: after `steps` under pressure no contact carries a force
  };

  struct PreparedSample
  {
    State state; // at rest (from a file: with its velocities); walls[0] and walls[1] are the platens, unless there is a lattice
    StepResult        last_step; // contacts and impulses of the sample
    double            step = 0;  // length of that step
    PreparationReport report;
  };

  // Generates a sample in three stages:
  // - The size follows from the number of grains, or the number from the size.
  // - Soft discs relax in a box (or a cell) at box_solid_fraction.
  // - Compaction steps with fixed platens and the lateral condition. With periodic sides of fixed width the upper platen is free
  //   under the pressure instead. A lattice is free in all components under the isotropic pressure.
  // Grains are numbered upward. A sample from a file, or from `grains`, gets platens and sides that touch it. With rough_platens
  // the grains near a platen become part of it at the end. `progress` is called with (step, expected steps), also between
  // iterations of the soft discs and between sweeps. If it returns false, the preparation stops: the report is not quiet and the
  // state cannot be used. While a file is read the state is empty, without walls. Throws std::invalid_argument on wrong files.
  // Throws it also if target_solid_fraction is out of reach; the message gives the range.
  PreparedSample prepare_sample(const SampleOptions                 &options,
                                const PreparationSetting            &setting,
                                const std::function<bool(int, int)> &progress,
                                const Grains                        *grains = nullptr);

} // namespace diptych::discrete
