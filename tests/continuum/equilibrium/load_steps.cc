// diptych: load steps: halving, failure and stop without a trace
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tests/continuum/problem_scenes.h"

namespace
{
  using namespace diptych::continuum::tests;

  void expect_same(const CommittedState &a, const CommittedState &b)
  {
    EXPECT_EQ(a.progress, b.progress);
    EXPECT_EQ(a.displacement, b.displacement);
    ASSERT_EQ(a.points.size(), b.points.size());
    for (std::size_t k = 0; k < a.points.size(); ++k)
      {
        EXPECT_EQ((a.points[k].stress - b.points[k].stress).norm(), 0);
        EXPECT_EQ(a.points[k].stress_zz, b.points[k].stress_zz);
        EXPECT_EQ(a.points[k].equivalent_plastic_strain, b.points[k].equivalent_plastic_strain);
        EXPECT_EQ(a.points[k].dissipation, b.points[k].dissipation);
      }
  }

  // A stop at the first, second or third check leaves the committed state unchanged, bit for bit. The second check lies between
  // two iterations of one step. A further call continues with the bits and counts of a run that was never stopped.
  TEST(LoadSteps, AStoppedStepLeavesNoTrace)
  {
    const QuadMesh mesh    = rectangle(14, 20, 4.);
    const Loading  loading = straight_loading(1, {20, -20}, {1});
    for (const LinearChoice choice : {LinearChoice::direct, LinearChoice::amg})
      {
        Options options            = with_steps({}, 1e-3);
        options.law                = LawKind::mohr_coulomb;
        options.linear_solver      = choice;
        int                  calls = 0;
        bool                 stops = false;
        BoundaryValueProblem stopped(mesh, Units(), loading, options), alone(mesh, Units(), loading, options);
        LoadDriver           driver(stopped, options, [&] { return stops && --calls == 0; }), driver_alone(alone, options);
        EXPECT_EQ(driver.equilibrate(), "");
        EXPECT_EQ(driver_alone.equilibrate(), "");
        int n_stopped = 0;
        for (int step = 0; step < 6; ++step)
          {
            const CommittedState before = stopped.committed();
            const StepCounts     count  = driver.state().count;
            calls = 1 + step % 3, stops = true;
            const std::string why = driver.step_towards(1);
            if (driver.was_stopped())
              {
                ++n_stopped;
                EXPECT_EQ(why, "stopped on request");
                expect_same(stopped.committed(), before);
                EXPECT_EQ(driver.state().count.newton_iterations, count.newton_iterations);
                stops = false;
                EXPECT_EQ(driver.step_towards(1), "");
              }
            EXPECT_FALSE(driver.was_stopped());
            EXPECT_EQ(driver_alone.step_towards(1), "");
            expect_same(stopped.committed(), alone.committed());
            EXPECT_EQ(stopped.platen_force(true), alone.platen_force(true));
            EXPECT_EQ(driver.state().count.newton_iterations, driver_alone.state().count.newton_iterations);
            EXPECT_EQ(driver.linear_solver().linear_iterations(), driver_alone.linear_solver().linear_iterations());
            EXPECT_EQ(driver.linear_solver().factorisations(), driver_alone.linear_solver().factorisations());
          }
        EXPECT_GT(n_stopped, 1);
      }
  }

  // Two problems follow the same path. One of them fails a far too long step in between. Its state keeps its bits, and its
  // further path is that of the other.
  TEST(LoadSteps, AFailedStepLeavesNoTrace)
  {
    const QuadMesh mesh    = rectangle(14, 20, 4.);
    const Loading  loading = straight_loading(1, {20, -20}, {1});
    for (const LawKind law : {LawKind::mohr_coulomb, LawKind::cosserat_mohr_coulomb})
      {
        Options options = with_steps({}, 1e-3);
        options.law     = law;
        BoundaryValueProblem tried(mesh, Units(), loading, options), untried(mesh, Units(), loading, options);
        LoadDriver           driver_tried(tried, options), driver_untried(untried, options);
        for (auto *driver : {&driver_tried, &driver_untried})
          {
            EXPECT_EQ(driver->equilibrate(), "");
            EXPECT_EQ(advance(driver == &driver_tried ? tried : untried, *driver, 4e-3), "");
          }
        const CommittedState  before = tried.committed();
        const Eigen::Vector2d force  = tried.platen_force(true);
        LinearSolver          solver(LinearMethod::supernodal);
        solver.restart(LinearMethod::supernodal, {});
        auto increment = tried.zero_vector();
        tried.begin_step(0.1);
        tried.impose(increment);
        const NewtonReport report = solve_step(tried, solver, {1e-5, 2}, increment);
        EXPECT_FALSE(report.converged);
        EXPECT_FALSE(report.message.empty());
        expect_same(tried.committed(), before);
        EXPECT_EQ(tried.platen_force(true), force);
        for (auto *driver : {&driver_tried, &driver_untried})
          EXPECT_EQ(advance(driver == &driver_tried ? tried : untried, *driver, 6e-3), "");
        expect_same(tried.committed(), untried.committed());
        EXPECT_EQ(tried.platen_force(true), untried.platen_force(true));
        EXPECT_GT(tried.committed().progress, before.progress);
      }
  }

  // End points of the first three steps towards 0.128.
  std::vector<double> first_steps(const BoundaryValueProblem &problem, LoadDriver &driver)
  {
    std::vector<double> ends;
    for (int k = 0; k < 3; ++k)
      {
        EXPECT_EQ(driver.step_towards(0.128), "");
        ends.push_back(problem.progress());
      }
    return ends;
  }

  // A first step that is far too long is halved until it converges. From there on the path is that of a run that began with
  // this length.
  TEST(LoadSteps, ATooLongFirstStepIsHalvedUntilItConverges)
  {
    const QuadMesh mesh        = rectangle(14, 20, 4.);
    Options        bold        = with({}, Platens::rough, Kinematics::updated);
    bold.max_newton_iterations = 8;
    bold.initial_step = bold.max_step = 0.128;
    bold.material.softening_strain    = 0.5;
    const Loading        loading      = straight_loading(1, {20, -20}, {1});
    BoundaryValueProblem one(mesh, Units(), loading, bold);
    LoadDriver           driver(one, bold);
    ASSERT_EQ(driver.equilibrate(), "");
    const std::vector<double> way = first_steps(one, driver);
    EXPECT_GT(driver.state().count.cut_backs, 0);

    Options careful      = bold;
    careful.initial_step = way[0];
    BoundaryValueProblem other(mesh, Units(), loading, careful);
    LoadDriver           second(other, careful);
    ASSERT_EQ(second.equilibrate(), "");
    EXPECT_EQ(way, first_steps(other, second));
    EXPECT_LT(second.state().count.cut_backs, driver.state().count.cut_backs);
    EXPECT_NEAR((one.platen_force(true) - other.platen_force(true)).norm(), 0, 1e-6 * other.platen_force(true).norm());
  }

  // Elastic, one step down through the lower platen. Equilibrium on the old shape exists, but every element would be inverted.
  TEST(LoadSteps, InvertedElementsAreRefused)
  {
    const QuadMesh mesh = rectangle(4, 6, 2.);
    for (const Kinematics geometry : {Kinematics::updated, Kinematics::small_strain})
      {
        const Options        options = with(elastic(), Platens::smooth, geometry);
        BoundaryValueProblem problem(mesh, Units(), straight_loading(1, {0, -6}, {2}), options);
        LinearSolver         solver(LinearMethod::supernodal);
        solver.restart(LinearMethod::supernodal, {});
        for (const double to : {1.2, 0.2})
          {
            Eigen::Matrix2d squeeze = Eigen::Matrix2d::Zero();
            squeeze(1, 1)           = -to;
            auto increment          = linear_field(problem, squeeze);
            problem.begin_step(to);
            problem.impose(increment);
            const NewtonReport report = solve_step(problem, solver, {1e-5, 20}, increment);
            EXPECT_EQ(report.converged, to < 1) << report.message;
            EXPECT_EQ(problem.is_folded(), to > 1);
            EXPECT_EQ(report.message.find("inverted") != std::string::npos, to > 1) << report.message;
          }
      }
    Options options      = with(elastic(), Platens::smooth, Kinematics::updated);
    options.initial_step = options.max_step = 1.2;
    options.min_step                        = 0.1;
    const Course c                          = course(mesh, straight_loading(1, {0, -6}, {1.2}), options);
    EXPECT_EQ(c.report.status, Status::not_converged);
    EXPECT_LT(c.report.axial_strain, 1);
    EXPECT_GT(c.report.axial_strain, 0.5) << "half of the step converged";
    EXPECT_GT(c.report.cut_backs, 0);
    for (const CellState &cell : c.snapshots.back().cell_state)
      EXPECT_GT(cell.area, 0);
  }

  // After an easy step the next one is longer by half, never beyond max_step. The rest of a stage is divided equally.
  TEST(LoadSteps, GrowAndDivideTheWayToAStage)
  {
    const QuadMesh mesh    = rectangle(4, 6, 2.);
    Options        options = with(elastic(), Platens::smooth, Kinematics::updated);
    options.initial_step   = 1e-3;
    options.max_step       = 4e-3;
    const Course        c  = finished(mesh, straight_loading(1, {0, -6}, {0.015, 0.02}), options);
    std::vector<double> sizes;
    for (std::size_t k = 1; k < c.rows.size(); ++k)
      sizes.push_back(c.rows[k].axial_strain - c.rows[k - 1].axial_strain);
    ASSERT_GE(sizes.size(), 5u);
    EXPECT_NEAR(sizes[0], 1e-3, 1e-12);
    EXPECT_GT(sizes[1], 1.3e-3);
    for (std::size_t k = 0; k < sizes.size(); ++k)
      {
        EXPECT_LT(sizes[k], 4e-3 * (1 + 1e-6));
        if (k > 0)
          {
            EXPECT_LT(sizes[k], 1.5 * sizes[k - 1] * (1 + 1e-6));
          }
      }
    // From the first to the second stage, 0.005 in steps of at most 0.004: two steps of 0.0025.
    EXPECT_NEAR(sizes[sizes.size() - 1], 2.5e-3, 1e-12);
    EXPECT_NEAR(sizes[sizes.size() - 2], 2.5e-3, 1e-12);
  }
} // namespace
