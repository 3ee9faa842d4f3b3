// diptych: samples, loadings and runs that the tests of the continuum panel share
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "continuum/mesh/mesh.h"
#include "continuum/panel/panel.h"
#include "tests/common.h"

namespace diptych::continuum::tests
{
  using namespace diptych::continuum;

  inline QuadMesh rectangle(const double width, const double height, const double element_size)
  {
    return rectangle_mesh({width, height, 0, element_size});
  }

  inline Outline wavy_outline(const double width, const double height, const int points, const double waviness)
  {
    Outline outline;
    for (int k = 0; k < points; ++k)
      {
        const double y    = height * k / (points - 1);
        const double wave = waviness * std::sin(2 * M_PI * 3 * y / height);
        outline.left.emplace_back(-wave, y);
        outline.right.emplace_back(width + wave, y);
      }
    return outline;
  }

  // Perfect plasticity: no hardening and no softening.
  inline Options perfectly_plastic(const LawKind law, const double friction, const double dilatancy, const double cohesion)
  {
    Options options;
    options.law                           = law;
    options.material.hardening            = kind_of<ConstantHardening>;
    options.material.friction_angle_peak  = friction;
    options.material.dilatancy_angle_peak = dilatancy;
    options.material.cohesion             = cohesion;
    return options;
  }

  inline Options elastic()
  {
    Options options;
    options.law = LawKind::linear_elastic;
    return options;
  }

  inline Options with(Options options, const Platens platens, const Kinematics geometry)
  {
    options.platens  = platens;
    options.geometry = geometry;
    return options;
  }

  // The upper platen moves by `travel` [length] per unit progress; the lower one is at rest. If the platen descends, the
  // progress is descent / height, otherwise travel / height.
  inline Loading straight_loading(const double pressure, const Eigen::Vector2d &travel, std::vector<double> stages)
  {
    Loading loading;
    loading.pressure         = pressure;
    loading.stages           = std::move(stages);
    loading.loading_variable = travel.y() != 0 ? LoadingVariable::axial_strain : LoadingVariable::shear_strain;
    for (unsigned int c = 0; c < 2; ++c)
      loading.platens[1][c].value = [rate = travel[c]](const double progress) { return rate * progress; };
    return loading;
  }

  inline Loading with_sides(Loading loading, const LateralCondition &sides)
  {
    loading.lateral = sides;
    return loading;
  }

  // All accepted steps have the same length.
  inline Options with_steps(Options options, const double step)
  {
    options.initial_step = options.max_step = step;
    return options;
  }

  inline Options adaptive(Options options)
  {
    options.refinement           = Refinement::adaptive;
    options.refinement_threshold = 0.5;
    return options;
  }

  // Optional requests to a run.
  struct Wishes
  {
    std::function<std::vector<Eigen::Matrix2d>(const Snapshot &)> initial_stress; // of the cells
    std::function<bool(std::size_t n_rows)>                       stop_requested; // called on the first process
    const Checkpoint                                             *resume       = nullptr;
    MPI_Comm                                                      communicator = MPI_COMM_WORLD;
  };

  // Result of a run of one panel: its rows, a snapshot of every stage reached and one of an early end.
  struct Course
  {
    Report                  report;
    std::vector<Snapshot>   snapshots;
    std::vector<HistoryRow> rows;
    Checkpoint              checkpoint; // at the end

    const HistoryRow &end() const { return rows.back(); }
  };

  inline Course course(const QuadMesh &mesh, const Loading &loading, const Options &options, const Wishes &wishes = {})
  {
    Course result;
    Hooks  hooks;
    if (wishes.stop_requested)
      hooks.stop_requested = [&] { return wishes.stop_requested(result.rows.size()); };
    hooks.on_row = [&](const HistoryRow &row) { result.rows.push_back(row); };
    Panel panel(mesh, Units(), loading, options, hooks, wishes.communicator);
    if (wishes.initial_stress)
      panel.set_initial_stress(wishes.initial_stress(panel.snapshot()));
    Status status = Status::finished;
    if (wishes.resume)
      panel.resume(*wishes.resume);
    else
      status = panel.prepare();
    for (int stage = panel.stage() + 1; status == Status::finished && stage <= int(loading.stages.size()); ++stage)
      {
        status = panel.advance_to(stage);
        result.snapshots.push_back(panel.snapshot());
      }
    result.report     = panel.report();
    result.checkpoint = panel.checkpoint();
    return result;
  }

  inline Course resumed(const QuadMesh &mesh, const Loading &loading, const Options &options, const Checkpoint &checkpoint)
  {
    Wishes wishes;
    wishes.resume = &checkpoint;
    return course(mesh, loading, options, wishes);
  }

  // A run that must reach its end.
  inline Course finished(const QuadMesh &mesh, const Loading &loading, const Options &options)
  {
    Course result = course(mesh, loading, options);
    if (result.report.status != Status::finished)
      throw std::runtime_error("the course ended early: " + result.report.message);
    EXPECT_EQ(result.report.progress, loading.stages.back());
    EXPECT_EQ(result.snapshots.size(), loading.stages.size());
    return result;
  }

  // d/d progress of a displacement, or a constant force.
  inline Drive travel(const double rate)
  {
    return {false, [rate](const double progress) { return rate * progress; }};
  }
  inline Drive force(const double value)
  {
    return {true, [value](double) { return value; }};
  }
} // namespace diptych::continuum::tests
