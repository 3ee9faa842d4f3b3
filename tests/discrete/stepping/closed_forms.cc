// diptych: single discs, pairs and rows whose motion is known in closed form
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>

#include <gtest/gtest.h>

#include "discrete/contacts/internal_moment.h"
#include "discrete/stepping/time_stepping.h"
#include "tests/discrete/small_scenes.h"

namespace
{
  using namespace diptych::discrete;
  using namespace diptych::tests;

  // Normal impulses / step of the contacts, by (i, j).
  double contact_force(const StepResult &result, const int i, const int j, const double step)
  {
    for (std::size_t k = 0; k < result.contacts.size(); ++k)
      if (result.contacts[k].i == i && result.contacts[k].j == j)
        return result.impulses[k].normal / step;
    ADD_FAILURE() << "no contact " << i << '-' << j;
    return NAN;
  }

  TEST(ClosedForm, DiscAtRestOnAPlaneCarriesItsWeight)
  {
    StepSetting setting     = exact_setting(0.01);
    setting.time.gravity_y  = -9.81;
    State            state  = disc_on_floor({0, 0});
    const StepResult result = advance(state, setting);
    EXPECT_NEAR(contact_force(result, 0, 1, 0.01), state.grains.mass[0] * 9.81, 1e-12 * state.grains.mass[0] * 9.81);
    EXPECT_NEAR(state.grains.velocity[0].norm(), 0, 1e-14);
  }

  // n discs of radius r, the topmost m_top heavy. The contact below disc k carries (n-1-k) m g + m_top g.
  TEST(ClosedForm, ColumnCarriesWhatIsAboveEachContact)
  {
    for (const ContactSolver solver : {ContactSolver::nsgs, ContactSolver::psor})
      {
        const int    n = 8;
        const double g = 9.81, step = 0.01;
        StepSetting  setting   = exact_setting(step);
        setting.solver.solver  = solver;
        setting.time.gravity_y = -g;
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
            const double force = k == 0 ? contact_force(result, 0, n, step) : contact_force(result, k - 1, k, step);
            EXPECT_NEAR(force, above, 1e-10 * above) << name_of(solver) << ", below disc " << k;
          }
      }
  }

  // For tan a <= 3 mu the disc rolls with (2/3) g sin a. Otherwise it slides with g (sin a - mu cos a) and turns with 2 mu g cos
  // a / r.
  TEST(ClosedForm, DiscOnAnInclineRollsOrSlides)
  {
    const double g = 9.81, step = 0.001, mu = 0.2, radius = 0.5;
    const int    n_steps = 50;
    for (const double slope : {0.2, 0.5, 0.54, 0.6, 0.9}) // atan(0.6) = 0.5404
      {
        StepSetting setting         = exact_setting(step);
        setting.time.gravity_x      = g * std::sin(slope);
        setting.time.gravity_y      = -g * std::cos(slope);
        setting.law.platen_friction = mu;
        State state                 = disc_on_floor({0, 0}, radius);
        for (int k = 0; k < n_steps; ++k)
          ASSERT_EQ(advance(state, setting).solve.status, SolveStatus::converged);
        const bool   rolls        = std::tan(slope) <= 3 * mu;
        const double acceleration = rolls ? 2. / 3 * g * std::sin(slope) : g * (std::sin(slope) - mu * std::cos(slope));
        const double turning      = rolls ? acceleration / radius : 2 * mu * g * std::cos(slope) / radius;
        const double time         = n_steps * step;
        EXPECT_NEAR(state.grains.velocity[0].x(), acceleration * time, 1e-10) << "slope " << slope;
        EXPECT_NEAR(state.grains.spin[0], -turning * time, 1e-9) << "slope " << slope; // downhill to the right: clockwise
      }
  }

  // Slips until t = v0/(3 mu g), and then rolls at (2/3) v0.
  TEST(ClosedForm, ThrownDiscEndsRollingAtTwoThirdsOfItsSpeed)
  {
    const double g = 10, mu = 0.3, v0 = 3, step = 0.001, slip_time = v0 / (3 * mu * g);
    StepSetting  setting        = exact_setting(step);
    setting.time.gravity_y      = -g;
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

  // Angle th from the normal, e_t = 0. For tan th > 3 mu (1+e) the disc slides throughout: v_t'/v_t = 1 - mu (1+e)/tan th;
  // otherwise 2/3.
  TEST(ClosedForm, ObliqueImpactOnAWall)
  {
    const double step = 0.01, mu = 0.25;
    for (const double e : {0., 0.5, 1.})
      for (double angle = 0.05; angle < 1.5; angle += 0.05)
        {
          StepSetting setting            = exact_setting(step);
          setting.law.normal_restitution = e;
          setting.law.platen_friction    = mu;
          const Eigen::Vector2d before(std::sin(angle), -std::cos(angle));
          State                 state = touching_at_mid_step(before, step);
          (void)advance(state, setting);
          const double tangential = std::tan(angle) > 3 * mu * (1 + e) ? 1 - mu * (1 + e) / std::tan(angle) : 2. / 3;
          EXPECT_NEAR(state.grains.velocity[0].x(), tangential * before.x(), 1e-12) << "e " << e << ", angle " << angle;
          EXPECT_NEAR(state.grains.velocity[0].y(), -e * before.y(), 1e-12) << "e " << e << ", angle " << angle;
        }
  }

  // Walton: sticks if |v_t|/|v_n| <= 3 mu (1+e_n)/(1+e_t), then I_t = (m/3)(1+e_t) v_t, otherwise mu I_n = mu m (1+e_n) v_n.
  TEST(ClosedForm, ObliqueImpactWithTangentialRestitution)
  {
    const double step = 0.01, mu = 0.25, en = 0.8, et = 0.6;
    for (double angle = 0.05; angle < 1.5; angle += 0.05)
      {
        StepSetting setting                = exact_setting(step);
        setting.law.normal_restitution     = en;
        setting.law.tangential_restitution = et;
        setting.law.platen_friction        = mu;
        const Eigen::Vector2d before(std::sin(angle), -std::cos(angle));
        State                 state = touching_at_mid_step(before, step);
        const double          mass  = state.grains.mass[0];
        (void)advance(state, setting);
        const bool   sticks  = std::tan(angle) <= 3 * mu * (1 + en) / (1 + et);
        const double impulse = sticks ? mass / 3 * (1 + et) * before.x() : mu * mass * (1 + en) * -before.y();
        EXPECT_NEAR(mass * (before.x() - state.grains.velocity[0].x()), impulse, 1e-12) << "angle " << angle;
      }
  }

  // Newton's law in a touching row, all in one step: the first disc keeps 1 - (1+e)(n-1)/n, the others get (1+e)/n of v0.
  TEST(ClosedForm, RowOfTouchingDiscsHitByTheFirst)
  {
    for (const int n : {2, 3, 5})
      for (const double e : {0., 0.5, 1.})
        {
          const double step              = 0.01;
          StepSetting  setting           = exact_setting(step);
          setting.law.normal_restitution = e;
          State state                    = row_of_discs(n, 0.);
          state.grains.position[0].x() -= 0.5 * step; // touches at mid-step
          ASSERT_EQ(advance(state, setting).solve.status, SolveStatus::converged);
          EXPECT_NEAR(state.grains.velocity[0].x(), 1 - (1 + e) * (n - 1) / n, 1e-11) << "n " << n << ", e " << e;
          for (int k = 1; k < n; ++k)
            EXPECT_NEAR(state.grains.velocity[k].x(), (1 + e) / n, 1e-11) << "n " << n << ", e " << e;
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

  // First apex e^2 h0 after a fall from h0. An impact may come up to one step early, so the error is first order in the step.
  TEST(ClosedForm, BouncingDiscReachesItsApexToFirstOrder)
  {
    const double g = 10, e = 0.8, drop = 1;
    const auto   apex_error = [&](const double step) {
      StepSetting setting            = exact_setting(step);
      setting.time.gravity_y         = -g;
      setting.law.normal_restitution = e;
      State state                    = disc_on_floor({0, 0});
      state.grains.position[0].y() += drop;
      double apex    = 0;
      bool   bounced = false;
      for (double time = 0; time < 1.0; time += step)
        {
          (void)advance(state, setting);
          bounced = bounced || state.grains.velocity[0].y() > 0;
          if (bounced)
            apex = std::max(apex, state.grains.position[0].y() - state.grains.radius[0]);
        }
      return std::abs(apex - e * e * drop);
    };
    // One step early at v = sqrt(2 g h0) = 4.5 changes the fall by at most step * v: bound 4.5 step (1 + e^2).
    EXPECT_LT(apex_error(1e-3), 7.5e-3);
    EXPECT_LT(apex_error(1e-4), 7.5e-4);
  }

  TEST(ClosedForm, FrictionlessElasticCollisionKeepsKineticEnergy)
  {
    const double step              = 0.01;
    StepSetting  setting           = exact_setting(step);
    setting.law.normal_restitution = 1;
    setting.law.friction           = 0;
    State state;
    add_grain(state.grains, {0, 0}, 0.5, 1.);
    add_grain(state.grains, {1.03, 0.3}, 0.4, 2.);
    state.grains.velocity = {{1, 0.2}, {-0.7, 0}};
    const double before   = kinetic_energy(state.grains);
    for (int k = 0; k < 50; ++k)
      ASSERT_EQ(advance(state, setting).solve.status, SolveStatus::converged);
    ASSERT_LT(state.grains.velocity[0].x(), 0.5) << "the discs must have collided";
    EXPECT_NEAR(kinetic_energy(state.grains), before, 1e-12 * before);
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
