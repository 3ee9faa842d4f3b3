// diptych: preload of the springs of penalty and compliant before the loading
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/panel/spring_press.h"

#include <cmath>

#include "discrete/samples/settling.h"
#include "discrete/samples/spring_compaction.h"
#include "discrete/samples/uniform_strain.h"

namespace diptych::discrete
{
  namespace
  {
    // Implicit springs take up the pressure in about ten steps.
    constexpr long   least_steps        = 20;
    constexpr double unbalanced_at_rest = 0.005, least_evenness = 0.85;

    void hold_prepared_stress(State &state, const SpringPress &press)
    {
      const LoadingMode mode = press.start.loading.mode;
      if (mode == LoadingMode::path)
        return;
      set_drives(state, {press.start.loading, press.start.lateral, {}, press.start.rate});
      if (mode != LoadingMode::plane_shear && press.prepared.report.steps > 0)
        state.walls[1].drive_y = AppliedForce{{{0.}, {press.prepared.last_step.wall_force[1].y()}}};
    }
  } // namespace

  std::optional<PressedSample> press_springs(State &state, SpringPress press, const std::function<bool(double)> &go_on)
  {
    const bool   implicit = press.setting.compliance.stiffness > 0;
    const double pressure = press.setting.pressure;
    if (!implicit)
      {
        press.setting.law  = same_friction(press.penalty.preload_friction);
        press.setting.step = penalty_step(state.grains, press.penalty.stiffness * pressure, press.penalty.step_fraction);
        state.impulses.clear();
      }
    else
      {
        press.setting.step             = press.prepared.step;
        press.setting.solver.tolerance = 1e-4;
      }
    press.setting.accept_unconverged = true;
    const double unit                = press.setting.mean_diameter * std::sqrt(press.density / pressure);
    const bool   far_sides           = implicit && has_far_sides(state, press.setting);
    if (far_sides)
      press.setting.step = step_on_springs(press.setting.compliance.stiffness / pressure, state, press.setting.mean_diameter) *
                           unit;
    const double duration = press.penalty.preload * unit;
    const long   n        = std::lround(std::ceil(duration / press.setting.step));

    stop(state);
    hold_prepared_stress(state, press);
    PenaltyState springs;
    StressServo  servo;
    StepCache    cache;
    cache.team = press.team;
    PressedSample pressed{{}, press.setting.step};
    bool          rests = false;
    for (long k = 0; k < n && !rests; ++k)
      {
        if (!go_on(double(k) / double(n)))
          return {};
        pressed.last_step = implicit ? advance(state, press.setting, cache)
                                     : advance_penalty(state, springs, press.setting, press.penalty, k == n - 1);
        if (pressed.last_step.solve.status == SolveStatus::blown_up)
          break;
        rests = implicit && k >= least_steps && pressed.last_step.unbalanced_force < unbalanced_at_rest;
        if (far_sides)
          {
            const SideStress stress = side_stress(state, pressed.last_step, press.setting);
            rests                   = rests && stress.is_reached(least_evenness);
            if (!rests)
              servo.approach(stress, press.setting.compliance.stiffness, state, cache);
          }
      }
    stop(state);
    return pressed;
  }
} // namespace diptych::discrete
