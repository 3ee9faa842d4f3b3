// diptych: small scenes that several tests use
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "discrete/panel/panel.h"

namespace diptych::tests
{
  using namespace diptych::discrete;

  // Plain Gauss-Seidel to round-off, without lateral action and friction unless a test sets them.
  inline StepSetting exact_setting(const double step)
  {
    StepSetting setting;
    setting.step              = step;
    setting.law               = {0., 0., 0., 0., 0.};
    setting.solver.solver     = ContactSolver::nsgs;
    setting.solver.tolerance  = 1e-14;
    setting.solver.max_sweeps = 100000;
    setting.lateral           = NoSides{};
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
    options.time.step          = 0.1;
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

  inline Course loaded(const SampleOptions &sample, const Loading &loading, const Options &options)
  {
    Course course;
    Hooks  hooks;
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

  inline ShearedSample sheared_sample()
  {
    PreparedSample sample = prepare_sample(small_sample(), {}, [](int, int) { return true; });
    ShearedSample  sheared;
    sheared.setting.step              = 0.1;
    sheared.setting.solver.tolerance  = 1e-5;
    sheared.setting.solver.max_sweeps = 400000;
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
