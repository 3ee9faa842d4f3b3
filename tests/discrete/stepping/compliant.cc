// diptych: implicit compliant contacts in closed form, their limits, ledgers and threads
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/stepping/penalty.h"
#include "tests/discrete/small_scenes.h"

namespace
{
  using namespace diptych::tests;

  StepSetting compliant_setting(const double step, const double stiffness, const double damping = 0)
  {
    StepSetting setting = exact_setting(step);
    setting.compliance  = {stiffness, damping};
    return setting;
  }

  // v' = -g h + r/m and r = -h^2 kn v' from rest at gap 0 give the force m g z/(1 + z) with z = h^2 kn/m, here 1.3e4. One long
  // step is thus as good as rest at the overlap m g/kn. Every two further steps divide the difference by 1 + z, the determinant
  // of the scheme.
  TEST(Compliant, DiscOnAFloorRestsAtItsWeightOverTheStiffnessAfterLongSteps)
  {
    const double stiffness = 1e4, g = 9.81, step = 1;
    State        state         = disc_on_floor({0, 0});
    StepSetting  setting       = compliant_setting(step, stiffness);
    setting.stepping.gravity_y = -g;
    const double weight = state.grains.mass[0] * g, z = step * step * stiffness / state.grains.mass[0];
    EXPECT_NEAR(advance(state, setting).wall_force[0].y(), weight * z / (1 + z), 1e-10 * weight);
    for (int k = 0; k < 6; ++k)
      expect_ledgers(advance(state, setting), 1e-10);
    const StepResult result = advance(state, setting);
    EXPECT_NEAR(result.wall_force[0].y(), weight, 1e-10 * weight);
    EXPECT_NEAR(result.largest_penetration, weight / stiffness, 1e-10 * weight / stiffness);
  }

  // The springs take up their forces in the first step, up to a share of about m/(h^2 kt), here 2e-4.
  TEST(Compliant, DiscOnAnInclineRestsRollsOrSlides)
  {
    const double g = 9.81, radius = 0.5, stiffness = 1e8, step = 0.01;
    // atan(0.6) = 0.5404
    for (const Slope &s :
         {Slope{0.1, 0.2}, {0.5, 0.2}, {0.9, 0.2}, {0.1, 0.5, 0.2}, {0.5, 0.5, 0.2}, {1., 0.5, 0.1}, {0.4, 0.3, 0.5}})
      {
        State       state   = disc_on_floor({0, 0}, radius);
        StepSetting setting = compliant_setting(step, stiffness);
        tilt(setting, s, g);
        for (int k = 0; k < 20; ++k)
          expect_ledgers(advance(state, setting), 1e-12);
        const auto [acceleration, turning] = on_an_incline(s, g, radius);
        EXPECT_NEAR(state.grains.velocity[0].x(), 20 * step * acceleration, 5e-4 * step * g) << "slope " << s.angle;
        EXPECT_NEAR(state.grains.spin[0], -20 * step * turning, 1e-3 * step * g / radius) << "slope " << s.angle;
      }
  }

  // Relative velocity of two discs after one met the other at speed 1.
  double restitution(const double fraction, const double damping)
  {
    State             state   = row_of_discs(2, 0.01);
    const double      step    = penalty_step(state.grains, 1e5, fraction);
    const StepSetting setting = compliant_setting(step, 1e5, damping);
    for (double time = 0; time < 0.05; time += step)
      EXPECT_EQ(advance(state, setting).solve.status, SolveStatus::converged);
    return state.grains.velocity[1].x() - state.grains.velocity[0].x();
  }

  // Springs and dashpots are those of `penalty`, whose restitution is exp(-(pi - 2a) tan a) with sin a = damping. Steps of f
  // sqrt(m/kn) damp by sqrt(2) f/2 of critical more, so that e falls by a factor of about exp(-pi f/sqrt(2)).
  TEST(Compliant, CollisionTendsToThatOfExplicitSpringsWithShortSteps)
  {
    for (const double beta : {0., 0.2})
      {
        const double a = std::asin(beta), expected = std::exp(-(M_PI - 2 * a) * std::tan(a));
        for (const double fraction : {0.02, 0.01})
          EXPECT_NEAR(restitution(fraction, beta), expected * std::exp(-M_PI * fraction / std::sqrt(2.)), 0.5 * fraction);
      }
  }

  // Three discs in contact take up the momentum of the first together, like rigid discs without rebound. The stiffness enters as
  // m/(h^2 kn).
  TEST(Compliant, RowOfDiscsTendsToRigidContactsWithStiffness)
  {
    for (const double stiffness : {1e4, 1e6})
      {
        State       rigid = row_of_discs(3, 0), compliant = rigid;
        StepSetting setting = exact_setting(0.1);
        for (State *state : {&rigid, &compliant})
          {
            for (Eigen::Vector2d &x : state->grains.position)
              x.x() += x.x() > 0 ? 0.05 : 0; // the first disc arrives at mid-step
            ASSERT_EQ(advance(*state, setting).solve.status, SolveStatus::converged);
            setting.compliance = {stiffness, 0.2};
          }
        const double share = M_PI / 4 / (0.1 * 0.1 * stiffness);
        for (int k = 0; k < 3; ++k)
          {
            EXPECT_NEAR(rigid.grains.velocity[k].x(), 1. / 3, 1e-12);
            EXPECT_NEAR(compliant.grains.velocity[k].x(), 1. / 3, 5 * share);
          }
      }
  }

  // A lattice that is large enough for several blocks of contacts falls on a floor and rubs over it.
  TEST(Compliant, StepGivesTheSameBitsOnEveryNumberOfThreadsAndClosesItsLedgers)
  {
    State lattice;
    lattice.walls = {{{0, 0}, {0, 1}}};
    for (int k = 0; k < 1600; ++k)
      {
        const int row = k / 40;
        add_grain(lattice.grains, {k % 40 + 0.5 * (row % 2), 0.5 + row * std::sqrt(0.75)}, 0.5, 1.);
        lattice.grains.velocity[k] = {0.1, -0.01 * (k % 7)};
      }
    StepSetting setting          = compliant_setting(0.1, 1e4, 0.2);
    setting.solver               = {};
    setting.solver.tolerance     = 1e-8;
    setting.stepping.gravity_y   = -0.1;
    setting.law.friction         = 0.4;
    setting.law.platen_friction  = 0.4;
    setting.law.rolling_friction = 0.1;
    std::vector<StepResult> steps;
    std::vector<State>      states;
    for (const int threads : {1, 2})
      {
        StepCache cache;
        cache.team  = std::make_shared<ThreadTeam>(threads);
        State state = lattice;
        for (int k = 0; k < 2; ++k)
          steps.push_back(advance(state, setting, cache));
        states.push_back(state);
        expect_ledgers(steps.back(), 1e-10);
        EXPECT_EQ(state.grains.position, states.front().grains.position);
        EXPECT_EQ(state.grains.spin, states.front().grains.spin);
      }
    EXPECT_GT(steps.front().energies.rolling_dissipation, 0);
  }
} // namespace
