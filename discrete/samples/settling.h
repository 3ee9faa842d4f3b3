// diptych: removes the overlaps of a compacted sample
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>

#include "discrete/stepping/time_stepping.h"

namespace diptych::discrete
{
  struct SettlingOptions
  {
    double largest_overlap  = 0; // largest overlap that may remain, between grains and with walls [length]
    double unbalanced_force = 0; // mean over grains / mean contact force that may remain
    // The first patient_steps steps require a tenth of unbalanced_force, which tiny and slender samples never reach.
    int patient_steps = 0;
    int most_steps    = 0;
  };

  struct Settled
  {
    StepResult last_step; // contacts and impulses of the final sample
    int        steps           = 0;
    double     largest_overlap = 0; // remaining [length]
    bool       quiet           = false;
  };

  // Steps of length `setting.step` from rest. Grains and walls are stopped after each step. The normal term is gap / h for gaps
  // of either sign. So each step moves the sample towards the equilibrium without overlap, under the same pressure and with the
  // same friction. `go_on` is called before each step.
  Settled settle(State                             &state,
                 StepSetting                        setting,
                 const SettlingOptions             &options,
                 const std::function<bool()>       &go_on,
                 const std::shared_ptr<ThreadTeam> &team);

  void stop(State &state);

  // True if grains press on each other. Between rigid walls a grain that presses on a wall also counts. Without sides there is no
  // pressure, so the result is always true.
  bool carries_anything(const StepResult &step, std::size_t n_grains, const LateralCondition &lateral);
} // namespace diptych::discrete
