// diptych: grains that are part of a fixed or a free platen
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tests/discrete/small_scenes.h"

namespace
{
  using namespace diptych::tests;

  // Platens at y = 0 and 10. The upper one has the mass `mass`, is free along y and moves along x at `speed`.
  State between_platens(const double mass, const double force, const double speed = 0)
  {
    State state;
    state.walls            = {{{0, 0}, {0, 1}}, {{0, 10}, {0, -1}}};
    state.walls[1].mass    = mass;
    state.walls[1].drive_x = PrescribedVelocity{{{0.}, {speed}}};
    state.walls[1].drive_y = AppliedForce{{{0.}, {-force}}};
    return state;
  }

  // A grain of a platen of mass M meets a disc head on: both get (M V + m v)/(M + m). Either number may be the lower one.
  TEST(PlatenGrains, MeetADiscWithThePlatensMass)
  {
    for (const bool platen_first : {true, false})
      {
        const double step = 0.01, mass = 7, platen_speed = -0.5, disc_speed = 0.8;
        State        state = between_platens(mass, 0);
        add_grain(state.grains, {0, platen_first ? 2 : 1}, 0.5, 1.);
        add_grain(state.grains, {0, platen_first ? 1 : 2}, 0.5, 1.);
        const int glued = platen_first ? 0 : 1, disc = 1 - glued;
        state.grains.fixed[glued]   = upper_platen_grain;
        state.walls[1].velocity     = {0, platen_speed};
        state.grains.velocity[disc] = {0, disc_speed};
        carry_platen_grains(state);
        EXPECT_EQ(state.grains.velocity[glued].y(), platen_speed);
        StepSetting setting = exact_setting(step);
        // They start so that they touch at mid-step.
        state.grains.position[disc].y() -= 0.5 * step * disc_speed;
        state.grains.position[glued].y() -= 0.5 * step * platen_speed;
        const StepResult result = advance(state, setting);
        const double     m = state.grains.mass[disc], common = (mass * platen_speed + m * disc_speed) / (mass + m);
        EXPECT_NEAR(state.grains.velocity[disc].y(), common, 1e-13) << platen_first;
        EXPECT_NEAR(state.walls[1].velocity.y(), common, 1e-13);
        EXPECT_EQ(state.grains.velocity[glued], state.walls[1].velocity);
        EXPECT_NEAR(result.wall_force[1].y() * step, m * (common - disc_speed), 1e-13) << "force of the platen on the sample";
        EXPECT_LT(result.momentum_residual, 1e-14);
        const StepEnergies &e = result.energies;
        EXPECT_NEAR(e.kinetic_change, 0 - e.impact_dissipation, 1e-14) << "the mass of the grain does not count";
      }
  }

  // A disc rests on two grains of the lower platen, below one grain of the upper platen, which is pressed with F. The lower
  // contacts carry F / (2 cos b) each, with sin b = a/(R + r). The upper contact and both platens carry F.
  TEST(PlatenGrains, PressADiscIntoASaddle)
  {
    const double a = 0.8, R = 0.6, r = 0.5, force = 3, step = 0.01, cosine = std::sqrt(1 - a * a / (R + r) / (R + r));
    const double rise = (R + r) * cosine, round_off = 1e-10; // an error of 1e-16 of a gap gives the force M gap/h^2
    for (const ContactSolver solver : {ContactSolver::nsgs, ContactSolver::psor})
      {
        State state = between_platens(20., force);
        add_grain(state.grains, {-a, 5 - rise}, R, 1.);
        add_grain(state.grains, {0, 5 + R + r}, R, 1.);
        add_grain(state.grains, {a, 5 - rise}, R, 1.);
        add_grain(state.grains, {0, 5}, r, 1.);
        state.grains.fixed                       = {lower_platen_grain, upper_platen_grain, lower_platen_grain, 0};
        StepSetting setting                      = exact_setting(step);
        setting.solver.solver                    = solver;
        const std::vector<Eigen::Vector2d> start = state.grains.position;
        for (int k = 0; k < 5; ++k)
          {
            const StepResult result = advance(state, setting);
            ASSERT_EQ(result.solve.status, SolveStatus::converged);
            ASSERT_EQ(result.contacts.size(), 3u) << "grains of platens meet only free grains";
            for (std::size_t c = 0; c < 3; ++c)
              EXPECT_NEAR(result.impulses[c].normal / step, result.contacts[c].i == 1 ? force : force / (2 * cosine), round_off);
            EXPECT_NEAR(result.wall_force[0].y(), force, round_off);
            EXPECT_NEAR(result.wall_force[1].y(), -force, round_off);
          }
        for (std::size_t i = 0; i < start.size(); ++i)
          EXPECT_NEAR((state.grains.position[i] - start[i]).norm(), 0, 1e-12) << i;
      }
  }

  // A sheared periodic sample between rough platens, the upper one free. Energy and momentum balance in every step. Grains of a
  // platen keep their places on it, and the sample carries shear force without friction of platens or grains.
  TEST(PlatenGrains, ShearASampleWithClosedLedgers)
  {
    SampleOptions sample = small_sample(150);
    sample.rough_platens = true;
    Loading loading;
    loading.mode            = LoadingMode::plane_shear;
    loading.inertial_number = 0.02;
    loading.stages          = {0.1, 0.2};
    Options options;
    options.stepping.step       = 0.05;
    options.accuracy.tolerance  = 1e-6;
    options.lateral.lateral     = Lateral::periodic;
    options.lateral.side_motion = SideMotion::velocity;
    options.law.friction = options.law.platen_friction = 0;
    const Course course                                = loaded(sample, loading, options);
    ASSERT_EQ(course.report.status, Status::finished) << course.report.message;
    double          shear  = 0;
    Eigen::Vector2d stress = Eigen::Vector2d::Zero(),
                    force  = Eigen::Vector2d::Zero(); // xy and yy of the mean stress, of the platen
    for (const HistoryRow &row : course.rows)
      {
        ASSERT_LT(std::abs(row.energy_residual), 1e-11);
        ASSERT_LT(row.momentum_residual, 1e-12);
        shear += row.upper_force.x() / double(course.rows.size());
        stress += row.stress.row(1).transpose();
        force -= 0.5 * (row.upper_force - row.lower_force) / course.snapshots[0].cell_width;
      }
    EXPECT_GT(shear, 0.05 * course.snapshots[0].cell_width) << "smooth frictionless platens would carry no shear force";
    // Height x force / area equals force / width, except for the inertia of the grains.
    EXPECT_NEAR(stress.y() / force.y(), 1, 0.02);
    EXPECT_NEAR(stress.x() / force.x(), 1, 0.04);
    const Snapshot &first = course.snapshots.front(), &last = course.snapshots.back();
    int             n_glued = 0;
    for (std::size_t i = 0; i < first.fixed.size(); ++i)
      if (first.fixed[i] > held_grain)
        {
          ++n_glued;
          const bool            upper  = first.fixed[i] == upper_platen_grain;
          const Eigen::Vector2d travel = upper ? last.upper_platen_displacement : Eigen::Vector2d::Zero();
          EXPECT_NEAR((last.position[i] - first.position[i] - travel).norm(), 0, 1e-11) << i;
          EXPECT_EQ(last.spin[i], 0);
          EXPECT_EQ(last.rattler[i], 0);
        }
    EXPECT_GT(n_glued, first.cell_width) << "more than one grain per diameter of the two platens";
  }
} // namespace
