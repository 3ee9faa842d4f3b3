// diptych: small scenes that several tests use
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "discrete/panel/panel.h"
#include "discrete/files/text_file.h"
#include "tests/common.h"

namespace diptych::tests
{
  using namespace diptych::discrete;

  // Plain Gauss-Seidel to round-off, without lateral action and friction unless a test sets them.
  inline StepSetting exact_setting(const double step, const double gravity_y = 0)
  {
    StepSetting setting;
    setting.step               = step;
    setting.stepping.gravity_y = gravity_y;
    setting.law                = same_friction(0);
    setting.solver.solver      = ContactSolver::nsgs;
    setting.solver.tolerance   = 1e-14;
    setting.solver.max_sweeps  = 100000;
    setting.lateral            = NoSides{};
    return setting;
  }

  inline State disc_on_floor(const Eigen::Vector2d &velocity, const double radius = 0.5)
  {
    State state;
    state.walls = {{{0, 0}, {0, 1}}};
    add_grain(state.grains, {0, radius}, radius, 1.);
    state.grains.velocity[0] = velocity;
    return state;
  }

  struct Slope
  {
    double angle, friction, rolling = 0;
  };

  inline void tilt(StepSetting &setting, const Slope &s, const double g)
  {
    setting.stepping.gravity_x          = g * std::sin(s.angle);
    setting.stepping.gravity_y          = -g * std::cos(s.angle);
    setting.law.platen_friction         = s.friction;
    setting.law.platen_rolling_friction = s.rolling;
  }

  // Acceleration and angular acceleration of a disc on a slope a, with t = tan a and the coefficients mu and mu_r. It rests for
  // t <= mu and t <= mu_r and rolls with (2/3) g (sin a - mu_r cos a) for t <= 3 mu - 2 mu_r. Otherwise it slides with
  // g (sin a - mu cos a), and turns with 2 (mu - mu_r) g cos a / r or, for mu_r >= mu, not at all.
  inline std::pair<double, double> on_an_incline(const Slope &s, const double g, const double radius)
  {
    const double pull = g * std::sin(s.angle), press = g * std::cos(s.angle), rolling = 2. / 3 * (pull - s.rolling * press);
    if (pull <= s.friction * press && pull <= s.rolling * press)
      return {0, 0};
    if (pull <= (3 * s.friction - 2 * s.rolling) * press)
      return {rolling, rolling / radius};
    return {pull - s.friction * press, 2 * std::max(0., s.friction - s.rolling) * press / radius};
  }

  // A disc whose gap to the floor is zero at mid-step, when contacts are searched.
  inline State touching_at_mid_step(const Eigen::Vector2d &velocity, const double step)
  {
    State state = disc_on_floor(velocity);
    state.grains.position[0] -= 0.5 * step * velocity;
    return state;
  }

  // n equal discs along x with the given gaps; the first moves at speed 1 towards the others.
  inline State row_of_discs(const int n, const double gap)
  {
    State state;
    for (int k = 0; k < n; ++k)
      add_grain(state.grains, {k * (1 + gap), 0}, 0.5, 1.);
    state.grains.velocity[0] = {1, 0};
    return state;
  }

  // The impulse of the contact of two bodies, zero if there is none.
  inline Impulse impulse_between(const StepResult &result, const int i, const int j)
  {
    for (std::size_t k = 0; k < result.contacts.size(); ++k)
      if (result.contacts[k].i == i && result.contacts[k].j == j)
        return result.impulses[k];
    return {};
  }

  // A converged step. Momentum: sum m dv = h F + impulses of walls and fixed grains. Energy: kinetic change = external work -
  // friction - rolling - impact. Impulses may be very small beside momenta of order 10.
  inline void expect_ledgers(const StepResult &result, const double energy_tolerance)
  {
    const StepEnergies &e = result.energies;
    ASSERT_EQ(result.solve.status, SolveStatus::converged);
    double impulse_sum = 0;
    for (const Impulse &r : result.impulses)
      impulse_sum += std::hypot(r.normal, r.tangential);
    ASSERT_LT(result.momentum_residual * impulse_sum, 1e-13);
    ASSERT_NEAR(e.kinetic_change, e.external_work - e.friction_dissipation - e.rolling_dissipation - e.impact_dissipation,
                energy_tolerance);
  }

  // A sample that takes less than a second to prepare.
  inline SampleOptions small_sample(const int grains = 300, const int seed = 1)
  {
    SampleOptions options;
    options.grains = grains;
    options.seed   = seed;
    return options;
  }

  inline Loading short_loading()
  {
    Loading loading;
    loading.inertial_number = 1e-3;
    loading.stages          = {0.005, 0.01};
    return loading;
  }

  inline Options quick_options()
  {
    Options options;
    options.stepping.step      = 0.1;
    options.accuracy.tolerance = 1e-4;
    return options;
  }

  // A loading with everything that it returned.
  struct Course
  {
    Report                  report;
    std::vector<Snapshot>   snapshots;
    std::vector<HistoryRow> rows;
    Grains                  prepared; // before the loading
  };

  // Prepares the panel, unless it is resumed, and loads it to its end. Takes a snapshot at the start, at every stage, and where
  // the loading ended early.
  inline Report run_to_end(Panel &panel, const int n_stages, std::vector<Snapshot> &snapshots, const bool is_resumed = false)
  {
    if (!is_resumed && panel.prepare() == Status::finished)
      snapshots.push_back(panel.snapshot());
    while (panel.stage() < n_stages && panel.report().status == Status::finished)
      {
        (void)panel.advance_to(panel.stage() + 1);
        if (panel.has_snapshot())
          snapshots.push_back(panel.snapshot());
      }
    return panel.report();
  }

  inline Course loaded(const SampleOptions &sample, const Loading &loading, const Options &options, Hooks hooks = {})
  {
    Course course;
    hooks.on_row = [&](const HistoryRow &row) { course.rows.push_back(row); };
    Panel panel(sample, loading, options, hooks);
    course.report = run_to_end(panel, int(loading.stages.size()), course.snapshots);
    if (!course.snapshots.empty())
      for (std::size_t i = 0; i < course.snapshots[0].radius.size(); ++i)
        add_grain(course.prepared, course.snapshots[0].position[i], course.snapshots[0].radius[i], sample.density);
    return course;
  }

  // A sheared state and the result of the step that led to it, for tests that need a real packing.
  struct ShearedSample
  {
    State       before, state;
    StepSetting setting;
    StepResult  result;
  };

  inline ShearedSample sheared_sample(const double rolling_friction = 0)
  {
    PreparedSample sample = prepare_sample(small_sample(), {}, [](int, int) { return true; });
    ShearedSample  sheared;
    sheared.setting.step                 = 0.1;
    sheared.setting.solver.tolerance     = 1e-5;
    sheared.setting.solver.max_sweeps    = 400000;
    sheared.setting.law.rolling_friction = sheared.setting.law.platen_rolling_friction = rolling_friction;
    // An affine start, because an impulsive start of a dense sample is much harder to solve.
    const Eigen::Vector2d velocity(0.02, -0.02);
    sample.state.walls[1].velocity = velocity;
    for (std::size_t i = 0; i < sample.state.grains.size(); ++i)
      sample.state.grains.velocity[i] = velocity * sample.state.grains.position[i].y() / sample.state.walls[1].point.y();
    for (int k = 0; k < 20; ++k)
      {
        sheared.before = sample.state;
        sheared.result = advance(sample.state, sheared.setting);
        if (sheared.result.solve.status != SolveStatus::converged)
          throw std::runtime_error("the sheared sample did not converge");
      }
    sheared.state = sample.state;
    return sheared;
  }
} // namespace diptych::tests
