// diptych: takes the overlaps out of a compacted sample
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>

#include "discrete/stepping/time_stepping.h"

namespace diptych::discrete
{
  struct SettlingOptions
  {
    double largest_overlap  = 0; // that may be left, between grains and with walls [length]
    double unbalanced_force = 0; // mean over grains / mean contact force, likewise
    int    patient_steps    = 0; // in which a tenth of that is wanted: tiny and slender samples never come to it
    int    most_steps       = 0;
  };

  struct Settled
  {
    StepResult last_step; // contacts and impulses that carry the sample as it stands
    int        steps           = 0;
    double     largest_overlap = 0; // left [length]
    bool       quiet           = false;
  };

  // Steps from rest of `setting.step`, grains and walls stopped after each, whose normal term is gap / h for gaps of either sign:
  // every one moves the sample towards the equilibrium that has no overlap, under the same pressure and with the same friction.
  // `go_on` is asked before each step.
  Settled settle(State &state, StepSetting setting, const SettlingOptions &options, const std::function<bool()> &go_on);

  // Everything stands still.
  void stop(State &state);

  // Whether grains press on each other; between rigid walls one that presses on a wall will do, without sides there is no
  // pressure.
  bool carries_anything(const StepResult &step, std::size_t n_grains, const LateralCondition &lateral);
} // namespace diptych::discrete
