// diptych: single discs, pairs and rows whose motion is known in closed form
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/contacts/internal_moment.h"
#include "discrete/stepping/time_stepping.h"
#include "tests/discrete/small_scenes.h"

namespace
{
  using namespace diptych::tests;

  // n discs of radius r, one or several, the topmost m_top heavy. The contact below disc k carries (n-1-k) m g + m_top g.
  TEST(ClosedForm, ColumnCarriesWhatIsAboveEachContact)
  {
    for (const auto &[n, solver, round_off] :
         {std::tuple{1, ContactSolver::nsgs, 1e-14}, {8, ContactSolver::nsgs, 1e-12}, {8, ContactSolver::psor, 1e-12}})
      {
        const double g = 9.81, step = 0.01;
        StepSetting  setting  = exact_setting(step, -g);
        setting.solver.solver = solver;
        State state;
        state.walls = {{{0, 0}, {0, 1}}};
        for (int k = 0; k < n; ++k)
          add_grain(state.grains, {0., 0.5 + k}, 0.5, k + 1 < n ? 1. : 20.);
        const StepResult result = advance(state, setting);
        ASSERT_EQ(result.solve.status, SolveStatus::converged);
        double above = 0;
        for (int k = n - 1; k >= 0; --k)
          {
            above += state.grains.mass[k] * g;
            const double force = impulse_between(result, k == 0 ? 0 : k - 1, k == 0 ? n : k).normal / step;
            EXPECT_NEAR(force, above, 100 * round_off * above) << name_of(solver) << ", below disc " << k;
            EXPECT_NEAR(state.grains.velocity[k].norm(), 0, round_off);
          }
      }
  }

  TEST(ClosedForm, DiscOnAnInclineRestsRollsOrSlides)
  {
    const double g = 9.81, step = 0.001, radius = 0.5;
    const int    n_steps  = 50;
    const Slope  slopes[] = {{0.2, 0.2},       {0.5, 0.2},      {0.54, 0.2},    {0.6, 0.2},      {0.9, 0.2}, {0.19, 0.5, 0.2},
                             {0.21, 0.5, 0.2}, {0.9, 0.5, 0.1}, {1., 0.5, 0.1}, {0.35, 0.3, 0.4}}; // atan(0.6) = 0.5404
    for (const Slope &s : slopes)
      {
        const double slope   = s.angle;
        StepSetting  setting = exact_setting(step);
        tilt(setting, s, g);
        State state = disc_on_floor({0, 0}, radius);
        for (int k = 0; k < n_steps; ++k)
          ASSERT_EQ(advance(state, setting).solve.status, SolveStatus::converged);
        const auto [acceleration, turning] = on_an_incline(s, g, radius);
        const double time                  = n_steps * step;
        EXPECT_NEAR(state.grains.velocity[0].x(), acceleration * time, 1e-10) << "slope " << slope;
        EXPECT_NEAR(state.grains.spin[0], -turning * time, 1e-9) << "slope " << slope; // downhill to the right: clockwise
      }
  }

  // Slips until t = v0/(3 mu g), and then rolls at (2/3) v0.
  TEST(ClosedForm, ThrownDiscEndsRollingAtTwoThirdsOfItsSpeed)
  {
    const double g = 10, mu = 0.3, v0 = 3, step = 0.001, slip_time = v0 / (3 * mu * g);
    StepSetting  setting        = exact_setting(step, -g);
    setting.law.platen_friction = mu;
    State  state                = disc_on_floor({v0, 0});
    double time_of_rolling      = NAN;
    for (int k = 1; k <= 600; ++k)
      {
        ASSERT_EQ(advance(state, setting).solve.status, SolveStatus::converged);
        const double slip = state.grains.velocity[0].x() + state.grains.radius[0] * state.grains.spin[0];
        if (std::isnan(time_of_rolling) && std::abs(slip) < 1e-12)
          time_of_rolling = k * step;
      }
    EXPECT_NEAR(time_of_rolling, slip_time, step * (1 + 1e-9));
    EXPECT_NEAR(state.grains.velocity[0].x(), 2. / 3 * v0, 1e-12);
  }

  // Walton, at the angle th from the normal: sticks if |v_t|/|v_n| <= 3 mu (1+e_n)/(1+e_t), then I_t = (m/3)(1+e_t) v_t,
  // otherwise mu I_n = mu m (1+e_n) v_n. For e_t = 0 a disc that sticks keeps two thirds of v_t.
  TEST(ClosedForm, ObliqueImpactOnAWall)
  {
    const double step = 0.01, mu = 0.25;
    for (const auto &[en, et] : {std::pair{0., 0.}, {0.5, 0.}, {1., 0.}, {0.8, 0.6}})
      for (double angle = 0.05; angle < 1.5; angle += 0.05)
        {
          StepSetting setting                = exact_setting(step);
          setting.law.normal_restitution     = en;
          setting.law.tangential_restitution = et;
          setting.law.platen_friction        = mu;
          const Eigen::Vector2d before(std::sin(angle), -std::cos(angle));
          State                 state = touching_at_mid_step(before, step);
          (void)advance(state, setting);
          const bool   sticks = std::tan(angle) <= 3 * mu * (1 + en) / (1 + et);
          const double lost   = sticks ? (1 + et) / 3 * before.x() : mu * (1 + en) * -before.y();
          EXPECT_NEAR(state.grains.velocity[0].x(), before.x() - lost, 1e-12) << "e " << en << ", angle " << angle;
          EXPECT_NEAR(state.grains.velocity[0].y(), -en * before.y(), 1e-12) << "e " << en << ", angle " << angle;
        }
  }

  // Gaps larger than the travel of a step: successive binary impacts pass the whole speed on to the last disc.
  TEST(ClosedForm, RowWithGapsHandsTheSpeedOnToTheLast)
  {
    const double step              = 0.01;
    StepSetting  setting           = exact_setting(step);
    setting.law.normal_restitution = 1;
    State state                    = row_of_discs(3, 0.05);
    for (int k = 0; k < 40; ++k)
      ASSERT_EQ(advance(state, setting).solve.status, SolveStatus::converged);
    EXPECT_NEAR(state.grains.velocity[0].x(), 0, 1e-12);
    EXPECT_NEAR(state.grains.velocity[1].x(), 0, 1e-12);
    EXPECT_NEAR(state.grains.velocity[2].x(), 1, 1e-12);
  }

  TEST(ClosedForm, FreeSpinningDiscHasAPureTensionMoment)
  {
    Grains grains;
    add_grain(grains, {3, 4}, 0.7, 2.);
    grains.spin[0]                = 5;
    const double          inertia = 0.5 * 2 * M_PI * 0.49 * 0.49; // m r^2 / 2
    const Eigen::Matrix2d moment  = internal_moments(grains.position, {}, spin_terms(grains))[0];
    EXPECT_NEAR((moment + 0.5 * inertia * 25 * Eigen::Matrix2d::Identity()).norm(), 0, 1e-13);
  }
} // namespace
