// diptych: driven and free walls, fixed grains, friction by pair, gravity
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tests/discrete/small_scenes.h"

namespace
{
  using namespace diptych::tests;

  // A column of n touching discs (d = 1) on a floor. A platen at a distance `gap` above it is free vertically under a force.
  State column_under_platen(const int n, const double gap, const TimeTable &downward, const double mass)
  {
    State state;
    state.walls         = {{{0, 0}, {0, 1}}, {{0, n + gap}, {0, -1}}};
    state.walls[1].mass = mass;
    TimeTable force     = downward;
    for (double &f : force.value)
      f = -f;
    state.walls[1].drive_y = AppliedForce{force};
    for (int k = 0; k < n; ++k)
      add_grain(state.grains, {0., 0.5 + k}, 0.5, 1.);
    return state;
  }

  // v = -(F/M) t until the platen meets the column; then it rests. Over the whole time the impulses balance: the impulse of the
  // platen on the sample is -(F T - M |v|) with v = 0 at the end, and that of the floor is the opposite.
  TEST(Walls, FreePlatenFallsWithForceOverMassAndIsStoppedByAColumn)
  {
    const double force = 3, mass = 5, step = 0.01, gap = 0.2;
    StepSetting  setting = exact_setting(step);
    State        state   = column_under_platen(4, gap, {{0.}, {force}}, mass);
    double       platen = 0, floor = 0;
    const int    n_steps = 100, n_fall = 80; // falls for sqrt(2 gap M/F) = 0.816
    for (int k = 1; k <= n_steps; ++k)
      {
        const StepResult result = advance(state, setting);
        ASSERT_EQ(result.solve.status, SolveStatus::converged);
        platen += step * result.wall_force[1].y(), floor += step * result.wall_force[0].y();
        if (k <= n_fall)
          {
            ASSERT_NEAR(state.walls[1].velocity.y(), -force / mass * k * step, 1e-13);
          }
        ASSERT_LT(result.largest_penetration, 1e-13);
      }
    EXPECT_NEAR(state.walls[1].velocity.y(), 0, 1e-13);
    EXPECT_NEAR(state.walls[1].point.y(), 4, 1e-13);
    EXPECT_NEAR(platen, -force * n_steps * step, 1e-12);
    EXPECT_NEAR(floor, force * n_steps * step, 1e-12);
  }

  // No servo and no lag: every contact of the column and the floor carry F of the middle of the step. This holds from the first
  // step on and also when F jumps from 1 to 3.
  TEST(Walls, FreePlatenAtRestTransmitsItsForceInTheSameStep)
  {
    for (const ContactSolver solver : {ContactSolver::nsgs, ContactSolver::psor})
      {
        const int    n    = 6;
        const double step = 0.02, jump = 0.1;
        StepSetting  setting  = exact_setting(step);
        setting.solver.solver = solver;
        State state           = column_under_platen(n, 0, {{0, jump, jump + 1e-12}, {1, 1, 3}}, 7.);
        for (int k = 0; k < 10; ++k)
          {
            const double     force  = k < 5 ? 1 : 3;
            const StepResult result = advance(state, setting);
            ASSERT_EQ(result.solve.status, SolveStatus::converged);
            for (int j = 1; j < n; ++j)
              EXPECT_NEAR(impulse_between(result, j - 1, j).normal / step, force, 1e-11) << name_of(solver) << ", step " << k;
            EXPECT_NEAR(result.wall_force[0].y(), force, 1e-11);
            EXPECT_NEAR(result.wall_force[1].y(), -force, 1e-11);
            EXPECT_NEAR(state.walls[1].velocity.y(), 0, 1e-12);
          }
      }
  }

  // F = P x height with the height in the middle of the step, h0 + V (t + h/2). The same holds for P x width on a platen.
  TEST(Walls, PressureActsOnThePresentHeightAndWidth)
  {
    const double step = 0.05, speed = 0.3, pressure = 2;
    StepSetting  setting = exact_setting(step);
    for (const bool upright : {false, true})
      {
        State state;
        state.walls = {{{0, 0}, {0, 1}}, {{0, 4}, {0, -1}}, {{0, 0}, {1, 0}}, {{4, 0}, {-1, 0}}};
        for (int k = 0; k < 4; ++k)
          add_grain(state.grains, upright ? Eigen::Vector2d(2, 0.5 + k) : Eigen::Vector2d(0.5 + k, 2), 0.5, 1.);
        Wall &free = state.walls[upright ? 1 : 3], &driven = state.walls[upright ? 3 : 1];
        (upright ? free.drive_y : free.drive_x)     = AppliedPressure{pressure};
        (upright ? driven.drive_x : driven.drive_y) = PrescribedVelocity{{{0.}, {speed}}};
        driven.velocity[upright ? 0 : 1]            = speed;
        for (int k = 0; k < 20; ++k)
          {
            const StepResult result = advance(state, setting);
            const double     length = 4 + speed * (k + 0.5) * step;
            EXPECT_NEAR(result.wall_force[upright ? 1 : 3][upright ? 1 : 0], -pressure * length, 1e-11);
            EXPECT_NEAR(impulse_between(result, 1, 2).normal / step, pressure * length, 1e-11);
          }
      }
  }

  // Discs between a fixed wall and a wall that is free under a force overlap by 0.02. They can separate only if the free wall
  // gives way: the row is 3 wide and the walls are 2.94 apart.
  TEST(Walls, PenetrationsAreRemovedIfAFreeWallMustGiveWay)
  {
    StepSetting setting = exact_setting(0.02);
    State       state;
    state.walls            = {{{0, 0}, {1, 0}}, {{2.94, 0}, {-1, 0}}};
    state.walls[1].drive_x = AppliedForce{{{0.}, {-2.}}};
    for (int k = 0; k < 3; ++k)
      add_grain(state.grains, {0.49 + 0.98 * k, 0}, 0.5, 1.);
    double penetration = 1;
    for (int k = 0; k < 50; ++k)
      penetration = advance(state, setting).largest_penetration;
    EXPECT_LT(penetration, 1e-3);
    EXPECT_NEAR(state.walls[1].point.x(), 3, 2e-3);
  }

  TimeTable shaking(const double amplitude, const double frequency, const double step, const int n_steps)
  {
    TimeTable table;
    for (int k = 0; k <= n_steps; ++k)
      table.time.push_back(k * step), table.value.push_back(amplitude * frequency * std::cos(frequency * k * step));
    return table;
  }

  // Floor at A sin wt. The disc feels g - A w^2 sin wt. With A w^2 < g it never leaves, and the force is m (g + dv/h). With A w^2
  // = 2 g it takes off at sin wt = 1/2, within one step.
  TEST(Walls, DiscOnAShakenFloorTakesOffWhereTheFloorFallsFasterThanItself)
  {
    const double g = 10, frequency = 20, step = 1e-3;
    const int    n_steps = 628; // two periods
    for (const double ratio : {0.9, 2.})
      {
        StepSetting setting      = exact_setting(step, -g);
        setting.solver.tolerance = 1e-13; // near take-off the force is a small difference of large terms
        const TimeTable velocity = shaking(ratio * g / (frequency * frequency), frequency, step, n_steps);
        State           state    = disc_on_floor({0, velocity.value[0]});
        state.walls[0].velocity  = {0, velocity.value[0]};
        state.walls[0].drive_y   = PrescribedVelocity{velocity};
        double take_off          = NAN;
        for (int k = 0; k < n_steps && std::isnan(take_off); ++k)
          {
            const StepResult result = advance(state, setting);
            ASSERT_EQ(state.walls[0].velocity.y(), velocity.at(state.time));
            if (result.wall_force[0].y() == 0)
              take_off = (k + 0.5) * step;
            else
              {
                const double acceleration = (velocity.value[k + 1] - velocity.value[k]) / step;
                ASSERT_NEAR(result.wall_force[0].y(), state.grains.mass[0] * (g + acceleration), 1e-9) << "step " << k;
              }
          }
        if (ratio < 1)
          {
            EXPECT_TRUE(std::isnan(take_off)) << take_off;
          }
        else
          {
            EXPECT_NEAR(take_off, M_PI / 6 / frequency, step);
          }
      }
  }

  // A disc of radius r at rest on two fixed discs of radius R, 2 a apart, with sin b = a/(R + r): N = m g / (2 cos b) each.
  TEST(FixedGrains, CarryADiscInTheirSaddle)
  {
    const double a = 0.8, R = 0.6, r = 0.5, g = 9.81, step = 0.01, cosine = std::sqrt(1 - a * a / (R + r) / (R + r));
    StepSetting  setting = exact_setting(step, -g);
    State        state;
    add_grain(state.grains, {-a, 0}, R, 1.);
    add_grain(state.grains, {a, 0}, R, 1.);
    add_grain(state.grains, {0, (R + r) * cosine}, r, 2.);
    state.grains.fixed[0] = state.grains.fixed[1] = 1;
    const StepResult result                       = advance(state, setting);
    const double     normal                       = state.grains.mass[2] * g / (2 * cosine);
    EXPECT_NEAR(impulse_between(result, 0, 2).normal / step, normal, 1e-12 * normal);
    EXPECT_NEAR(impulse_between(result, 1, 2).normal / step, normal, 1e-12 * normal);
    EXPECT_NEAR(state.grains.velocity[2].norm(), 0, 1e-13);
    EXPECT_EQ(state.grains.position[0], Eigen::Vector2d(-a, 0));
    EXPECT_LT(result.momentum_residual, 1e-15) << "the support of the fixed grains returns the impulses";
  }

  // A disc starts at rest at the angle th0 on a fixed disc: (1 + k) v^2/2 = g l (cos th0 - cos th), l = R + r. It leaves at v^2/l
  // = g cos th, i.e. cos th = 2 cos th0/(3 + k). k = 1/2 for rolling (2/7 x 2 = 4/7) and 0 for sliding without friction (2/3).
  // The error is of first order in h.
  TEST(FixedGrains, ADiscRollingOverOneLeavesWhereItsWeightNoLongerHoldsIt)
  {
    for (const bool rough : {false, true})
      for (const double step : {1e-3, 2.5e-4})
        {
          const double R = 1, r = 0.5, start = 0.3;
          StepSetting  setting     = exact_setting(step, -10);
          setting.solver.tolerance = 1e-6; // impulses approach zero where it leaves, i.e. round-off of m v
          setting.law.friction     = rough ? 1000. : 0.;
          State state;
          add_grain(state.grains, {0, 0}, R, 1.);
          add_grain(state.grains, {(R + r) * std::sin(start), (R + r) * std::cos(start)}, r, 1.);
          state.grains.fixed[0] = 1;
          double last           = 0;
          while (state.grains.position[1].y() > 0)
            {
              const StepResult result = advance(state, setting);
              ASSERT_EQ(result.solve.status, SolveStatus::converged)
                << "residual " << result.solve.residual << ", impulse " << result.impulses[0].normal << ", rough " << rough;
              if (impulse_between(result, 0, 1).normal > 0)
                last = -result.contacts[0].normal.y();
            }
          EXPECT_NEAR(last, (rough ? 4. / 7 : 2. / 3) * std::cos(start), 5 * step) << "rough " << rough << ", step " << step;
          // Rolling: r omega = -v; sliding: no spin.
          EXPECT_EQ(state.grains.spin[1] == 0, !rough);
        }
  }

  // Grains fall on fixed grains, one of which moves and spins. It keeps its motion, and the ledgers close in every step.
  TEST(FixedGrains, KeepTheirMotionAndTheLedgers)
  {
    StepSetting setting            = exact_setting(0.01, -10);
    setting.law                    = same_friction(0.3);
    setting.law.normal_restitution = 0.5, setting.law.tangential_restitution = 0.2;
    setting.solver.tolerance = 1e-12;
    State state;
    state.walls = {{{0, -0.5}, {0, 1}}};
    for (int k = 0; k < 12; ++k)
      add_grain(state.grains, {0.9 * (k % 4) + 0.1 * (k / 4), 1.2 * (k / 4)}, 0.4 + 0.01 * k, 1.);
    for (int k = 0; k < 4; ++k)
      state.grains.fixed[k] = 1;
    state.grains.velocity[2] = {0.2, 0.1};
    state.grains.spin[2]     = 3;
    const Grains start       = state.grains;
    double       work        = 0;
    for (int k = 0; k < 200; ++k)
      {
        const StepResult    result = advance(state, setting);
        const StepEnergies &e      = result.energies;
        ASSERT_EQ(result.solve.status, SolveStatus::converged);
        ASSERT_LT(result.momentum_residual, 1e-13);
        ASSERT_NEAR(e.kinetic_change, e.external_work - e.friction_dissipation - e.impact_dissipation, 1e-12);
        work += e.external_work;
      }
    for (int k = 0; k < 4; ++k)
      {
        EXPECT_NEAR((state.grains.position[k] - start.position[k] - 2. * start.velocity[k]).norm(), 0, 1e-12);
        EXPECT_EQ(state.grains.velocity[k], start.velocity[k]);
        EXPECT_EQ(state.grains.spin[k], start.spin[k]);
      }
    EXPECT_NE(work, 0);
  }

  // tan(slope) = 3 > 3 mu for all pairs. Each disc slides, and r_t = mu r_n with the coefficient of its pair.
  TEST(Friction, IsThatOfThePair)
  {
    const double friction[3] = {0.1, 0.2, 0.3}; // grain on grain, platen, side wall
    for (int pair = 0; pair < 3; ++pair)
      {
        StepSetting setting         = exact_setting(0.01);
        setting.law.friction        = friction[0];
        setting.law.platen_friction = friction[1];
        setting.law.wall_friction   = friction[2];
        setting.stepping.gravity_x = 3, setting.stepping.gravity_y = -1;
        State state = disc_on_floor({0, 0});
        if (pair == 0)
          {
            state.walls.clear();
            add_grain(state.grains, {0, -0.5}, 0.5, 1.);
            state.grains.fixed[1] = 1;
          }
        else if (pair == 2)
          state.walls[0].kind = WallKind::side;
        const Impulse r = impulse_between(advance(state, setting), 0, 1);
        EXPECT_NEAR(std::abs(r.tangential) / r.normal, friction[pair], 1e-14);
        EXPECT_NEAR(r.normal, 0.01 * state.grains.mass[0], 1e-14);
      }
  }

  // A platen moves sideways at V and is pressed down by F on a disc on a smooth floor. mu F drives the disc until its upper
  // surface keeps up, v + r omega = 3 J/m = V. So v = V/3 from t = m V/(3 mu F) on, and r omega = 2 V/3.
  TEST(Friction, APressedPlatenTakesADiscAlongAtAThirdOfItsSpeed)
  {
    const double step = 1e-3, mu = 0.5, force = 2, speed = 0.6;
    StepSetting  setting        = exact_setting(step);
    setting.law.platen_friction = mu;
    State state                 = column_under_platen(1, 0, {{0.}, {force}}, 4.);
    state.walls[0].kind         = WallKind::side; // wall_friction = 0
    state.walls[1].velocity.x() = speed;
    const double mass = state.grains.mass[0], sliding = mass * speed / (3 * mu * force);
    for (int k = 1; k <= 200; ++k)
      {
        (void)advance(state, setting);
        ASSERT_NEAR(state.grains.velocity[0].x(), std::min(mu * force / mass * k * step, speed / 3), 1e-11);
      }
    ASSERT_LT(sliding, 0.19);
    EXPECT_NEAR(state.grains.spin[0] * 0.5, -2 * speed / 3, 1e-11);
    EXPECT_NEAR(state.walls[1].velocity.x(), speed, 1e-15);
  }

  // One free component of an oblique wall would couple the normal and tangential parts of its contacts.
  TEST(Walls, ObliqueWallWithOneFreeComponentIsRefused)
  {
    State state;
    state.walls            = {{{0, 0}, Eigen::Vector2d(1, 1).normalized()}};
    state.walls[0].drive_y = AppliedForce{{{0.}, {1.}}};
    EXPECT_THROW(validate_walls(state), std::invalid_argument);
    state.walls[0].drive_x = AppliedForce{{{0.}, {0.}}};
    EXPECT_NO_THROW(validate_walls(state));
    state.walls[0].mass = 0;
    EXPECT_THROW(validate_walls(state), std::invalid_argument);
    state.walls[0].mass    = 1;
    state.walls[0].drive_x = AppliedPressure{1.}; // without a height
    EXPECT_THROW(validate_walls(state), std::invalid_argument);
    state.walls[0].normal  = {1, 0};
    state.walls[0].drive_x = AppliedPressure{1., 2.};
    EXPECT_NO_THROW(validate_walls(state));
  }

  // A wall that is free in both components is like any other body: v' = v - (1+e) m_eff/m (u.n) n, V' = V + (1+e) m_eff/M (u.n)
  // n.
  TEST(Walls, ObliqueFreeWallReboundsLikeABodyOfItsMass)
  {
    const double          step = 0.01, M = 2.5, e = 0.7;
    const Eigen::Vector2d n        = Eigen::Vector2d(-0.6, 0.8), before(1, -0.5);
    StepSetting           setting  = exact_setting(step);
    setting.law.normal_restitution = e;
    State state;
    state.walls            = {{{0, 0}, n}};
    state.walls[0].drive_x = state.walls[0].drive_y = AppliedForce{{{0.}, {0.}}};
    state.walls[0].mass                             = M;
    add_grain(state.grains, 0.5 * n - 0.5 * step * before, 0.5, 1.);
    state.grains.velocity[0] = before;
    const double m = state.grains.mass[0], push = (1 + e) * m * M / (m + M) * -before.dot(n);
    (void)advance(state, setting);
    EXPECT_NEAR((state.grains.velocity[0] - before - push / m * n).norm(), 0, 1e-14);
    EXPECT_NEAR((state.walls[0].velocity + push / M * n).norm(), 0, 1e-14);
  }

  // q = g t^2/2 exactly, because the midpoint rule is exact for it. In a corner each wall carries its component of the weight.
  TEST(Gravity, ActsInAnyDirection)
  {
    for (const double angle : {0.3, 1.1, 2.5, 4.0, 5.5})
      {
        const Eigen::Vector2d g       = 3 * Eigen::Vector2d(std::cos(angle), std::sin(angle));
        StepSetting           setting = exact_setting(0.05);
        setting.stepping.gravity_x = g.x(), setting.stepping.gravity_y = g.y();
        State state;
        add_grain(state.grains, {0, 0}, 0.5, 2.);
        for (int k = 0; k < 20; ++k)
          (void)advance(state, setting);
        EXPECT_NEAR((state.grains.position[0] - 0.5 * g).norm(), 0, 1e-13);

        const double right = g.x() > 0 ? 1 : -1, up = g.y() > 0 ? 1 : -1;
        State        corner;
        corner.walls = {{{0, 0.5 * up}, {0, -up}}, {{0.5 * right, 0}, {-right, 0}}};
        add_grain(corner.grains, {0, 0}, 0.5, 2.);
        const StepResult      result = advance(corner, setting);
        const Eigen::Vector2d weight = corner.grains.mass[0] * g;
        EXPECT_NEAR(result.wall_force[0].y(), -weight.y(), 1e-12);
        EXPECT_NEAR(result.wall_force[1].x(), -weight.x(), 1e-12);
      }
  }
} // namespace
