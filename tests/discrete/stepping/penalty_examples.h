// diptych: examples of explicit smooth contacts for tests
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Eigenvalues>

#include "discrete/stepping/penalty.h"
#include "discrete/samples/soft_relaxation.h"
#include "tests/discrete/small_scenes.h"

namespace
{
  using namespace diptych::tests;

  constexpr double kt_over_kn = 0.5; // penalty.h

  // With pressure 1, PenaltyOptions::stiffness is kn.
  struct Penalty
  {
    double         step;
    StepSetting    setting;
    PenaltyOptions options;
    PenaltyState   kept;

    Penalty(const double h, const double stiffness, const double damping = 0)
        : step(h),
          setting(exact_setting(h)),
          options{stiffness, 0, damping}
    {
      setting.pressure = 1;
    }

    StepResult advance(State &state, const bool with_ledger = true)
    {
      return advance_penalty(state, kept, setting, options, with_ledger);
    }
  };

  struct Collision
  {
    double duration, restitution;
  };

  // Two equal discs, the first at speed 1 towards the second.
  inline Collision head_on(const double stiffness, const double damping, const double fraction)
  {
    State        state = row_of_discs(2, 0.01);
    const double step  = penalty_step(state.grains, stiffness, fraction);
    Penalty      penalty(step, stiffness, damping);
    int          closed = 0;
    for (double time = 0; time < 0.05; time += step)
      closed += !penalty.advance(state).contacts.empty();
    return {closed * step, state.grains.velocity[1].x() - state.grains.velocity[0].x()};
  }

  inline void add_box(State &state, const double width, const double height)
  {
    state.walls = {{{0, 0}, {0, 1}}, {{0, height}, {0, -1}}, {{0, 0}, {1, 0}}, {{width, 0}, {-1, 0}}};
    for (const std::size_t w : {2, 3})
      state.walls[w].kind = WallKind::side;
  }
} // namespace
