// diptych: preload of the springs of the penalty method before the loading
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/panel/spring_press.h"

#include <cmath>

#include "discrete/samples/settling.h"

namespace diptych::discrete
{
  std::optional<PressedSample> press_springs(State &state, SpringPress press, const std::function<bool(double)> &go_on)
  {
    const double pressure = press.setting.pressure;
    press.setting.law     = same_friction(press.penalty.preload_friction);
    press.setting.step    = penalty_step(state.grains, press.penalty.stiffness * pressure, press.penalty.step_fraction);
    const double duration = press.penalty.preload * press.setting.mean_diameter * std::sqrt(press.density / pressure);
    const long   n        = std::lround(std::ceil(duration / press.setting.step));

    stop(state);
    state.impulses.clear();
    if (press.start.loading.mode != LoadingMode::path) // a path starts from the isotropic pressure of the preparation
      set_drives(state, {press.start.loading, press.start.lateral, {}, press.start.rate});
    PenaltyState  springs;
    PressedSample pressed{{}, press.setting.step};
    for (long k = 0; k < n; ++k)
      {
        if (!go_on(double(k) / double(n)))
          return {};
        pressed.last_step = advance_penalty(state, springs, press.setting, press.penalty);
        if (pressed.last_step.solve.status != SolveStatus::converged)
          break;
      }
    stop(state);
    return pressed;
  }
} // namespace diptych::discrete
