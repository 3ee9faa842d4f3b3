// diptych: a grain sample between two platens, ready to be loaded
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <string>

#include "discrete/samples/sample_options.h"
#include "discrete/stepping/time_stepping.h"

namespace diptych::discrete
{
  // Throws std::invalid_argument naming key and range where options contradict each other.
  void validate(const SampleOptions &options);

  // What may be left between the grains of a prepared sample. [mean diameters]
  inline constexpr double largest_prepared_overlap = 1e-4;

  struct PreparationReport
  {
    bool   quiet    = false;
    int    steps    = 0;
    double residual = 0, unbalanced_force = 0; // of the last step
    double solid_fraction  = 0;                // grain area / sample area
    double soft_overlap    = 0;                // largest overlap left by the soft discs [length]
    int    settling_steps  = 0;                // after `steps`, from rest, that took out the overlaps
    double largest_overlap = 0;                // between grains and with walls, at the end [mean diameters]
    double friction        = 0;                // of the preparation
    bool   touches         = true;             // false: pressed for `steps`, but nothing carries anything
  };

  struct PreparedSample
  {
    State             state;     // at rest (a sample from a file: with its velocities); walls[0], walls[1]: the platens
    StepResult        last_step; // contacts and impulses that carry it
    double            step = 0;  // length of that step
    PreparationReport report;
  };

  // 1. size from count or count from size; 2. soft discs relaxed in a box (or a cell) at box_solid_fraction; 3. steps with
  // platens fixed and the lateral condition on (periodic sides of fixed width: the upper platen is free under the pressure
  // instead). Grains are numbered upward. Or grains from a file, with platens and sides where they touch them.
  // `progress` is called with (step, expected steps), between iterations of the soft discs and sweeps too, and stops the
  // preparation when it returns false: the report then says not quiet, and the state is none to go on from. While a file is read
  // there is no state at all, and it has no wall.
  // Throws std::invalid_argument on wrong files and where target_solid_fraction is out of reach, naming what can be reached.
  // `grains`: in the place of a file's, from arrays. rough_platens: at the end grains near a platen become part of it.
  PreparedSample prepare_sample(const SampleOptions                 &options,
                                const PreparationSetting            &setting,
                                const std::function<bool(int, int)> &progress,
                                const Grains                        *grains = nullptr);

} // namespace diptych::discrete
