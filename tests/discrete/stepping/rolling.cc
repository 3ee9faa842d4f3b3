// diptych: rolling resistance of single discs and pairs in closed form
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tests/discrete/stepping/penalty_examples.h"

namespace
{
  constexpr double g = 10, mu = 0.3, mu_r = 0.1, surface = 5.5;

  // Slips until t = s0/((3 mu + 2 mu_r) g), because v grows by mu g and the surface speed s0 loses 2 (mu + mu_r) g. From
  // v = mu g t on it rolls and loses (2/3) mu_r g. The couple mu_r m g r turns with s/r.
  struct Spun
  {
    double slip_time = surface / ((3 * mu + 2 * mu_r) * g), slip_path = 0.5 * mu * g * slip_time * slip_time,
           rolling_path = 0.75 * std::pow(mu * g * slip_time, 2) / (mu_r * g),
           turns_slip   = surface * slip_time - (mu + mu_r) * g * slip_time * slip_time;

    double path() const { return slip_path + rolling_path; }
    double lost(const double mass) const { return mu_r * mass * g * (turns_slip + rolling_path); }
  };

  State spinning_disc()
  {
    State state          = disc_on_floor({0, 0});
    state.grains.spin[0] = -surface / state.grains.radius[0];
    return state;
  }

  void put_on_floor(StepSetting &setting)
  {
    setting.stepping.gravity_y          = -g;
    setting.law.platen_friction         = mu;
    setting.law.platen_rolling_friction = mu_r;
  }

  // A step in which slipping or rolling ends adds errors of the order of g h^2.
  TEST(Rolling, ASpinningDiscStopsAfterTheRightPathAndHasLostTheRightEnergy)
  {
    const double step    = 0.001;
    StepSetting  setting = exact_setting(step);
    put_on_floor(setting);
    State  state = spinning_disc();
    double lost  = 0;
    for (int k = 0; k < 3000; ++k)
      {
        const StepResult result = advance(state, setting);
        expect_ledgers(result, 1e-14);
        EXPECT_GE(result.energies.rolling_dissipation, -1e-30);
        lost += result.energies.rolling_dissipation;
      }
    const Spun expected;
    EXPECT_NEAR(state.grains.position[0].x(), expected.path(), 2 * g * step * step);
    EXPECT_NEAR(lost, expected.lost(state.grains.mass[0]), 2 * g * step * step);
    EXPECT_NEAR(state.grains.velocity[0].x(), 0, 1e-13);
    EXPECT_NEAR(state.grains.spin[0], 0, 1e-13);
  }

  // At the end the springs swing by forces of mu_r m g.
  TEST(Rolling, OnSpringsASpinningDiscStopsAfterTheSamePath)
  {
    const double stiffness = 1e6, step = 1e-4;
    Penalty      penalty(step, stiffness);
    put_on_floor(penalty.setting);
    State        state = spinning_disc();
    const double mass = state.grains.mass[0], deflection = mass * g / stiffness;
    state.grains.position[0].y() -= deflection;
    double lost = 0;
    for (int k = 0; k < 30000; ++k)
      {
        const StepResult result = penalty.advance(state);
        expect_ledgers(result, 1e-13);
        lost += result.energies.rolling_dissipation;
      }
    const Spun expected;
    EXPECT_NEAR(state.grains.position[0].x(), expected.path(), 10 * deflection);
    EXPECT_NEAR(lost, expected.lost(mass), 10 * deflection * mass * g);
  }

  // The first of two unequal discs spins and meets the second one head on at speed 1.
  struct SpinningPair
  {
    double      step    = 0.01, spin;
    StepSetting setting = exact_setting(step);
    State       state;

    SpinningPair(const double first_spin, const double friction, const double rolling)
        : spin(first_spin)
    {
      add_grain(state.grains, {0 - 0.5 * step, 0}, 0.5, 1.);
      add_grain(state.grains, {0.8, 0}, 0.3, 1.);
      state.grains.velocity[0]     = {1, 0};
      state.grains.spin[0]         = spin;
      setting.law.friction         = friction;
      setting.law.rolling_friction = rolling;
    }
    double inertia(const int i) const { return state.grains.moment_of_inertia(i); }
    double effective_mass() const { return 1 / (1 / state.grains.mass[0] + 1 / state.grains.mass[1]); }
  };

  // The length of the law is the harmonic mean 2 r_i r_j/(r_i + r_j) = 0.375.
  TEST(Rolling, WithoutFrictionACoupleBrakesOneDiscAndDrivesTheOther)
  {
    for (const double spin : {5., -5.})
      {
        SpinningPair     pair(spin, 0, 0.02);
        const double     couple = 0.02 * 0.375 * pair.effective_mass() * (spin > 0 ? 1 : -1);
        const StepResult result = advance(pair.state, pair.setting);
        expect_ledgers(result, 1e-15);
        EXPECT_NEAR(pair.state.grains.spin[0], spin - couple / pair.inertia(0), 1e-13);
        EXPECT_NEAR(pair.state.grains.spin[1], couple / pair.inertia(1), 1e-13);
      }
    SpinningPair stuck(5, 0, 100);
    expect_ledgers(advance(stuck.state, stuck.setting), 1e-15);
    for (const double spin : stuck.state.grains.spin)
      EXPECT_NEAR(spin, 5 * stuck.inertia(0) / (stuck.inertia(0) + stuck.inertia(1)), 1e-12);
  }

  // Neither sliding nor rolling: one body with the moment of inertia I_1 + I_2 + m_eff (r_1 + r_2)^2.
  TEST(Rolling, TwoDiscsThatNeitherSlideNorRollTurnAsOneBody)
  {
    for (const ContactSolver solver : {ContactSolver::nsgs, ContactSolver::psor})
      {
        SpinningPair pair(5, 100, 100);
        pair.setting.solver.solver = solver;
        const double turning = 5 * pair.inertia(0) / (pair.inertia(0) + pair.inertia(1) + pair.effective_mass() * 0.8 * 0.8);
        expect_ledgers(advance(pair.state, pair.setting), 1e-14);
        const Grains &grains = pair.state.grains;
        EXPECT_NEAR(grains.spin[0], turning, 1e-12);
        EXPECT_NEAR(grains.spin[1], turning, 1e-12);
        EXPECT_NEAR((grains.velocity[1] - grains.velocity[0]).y(), 0.8 * turning, 1e-12);
      }
  }

  // The support of a held grain that turns does work with the couple.
  TEST(Rolling, AHeldGrainThatTurnsDrivesADiscAndItsSupportPaysForIt)
  {
    SpinningPair pair(0, 0.2, 0.05);
    pair.state.grains.fixed[1] = held_grain;
    pair.state.grains.spin[1]  = 3;
    const StepResult result    = advance(pair.state, pair.setting);
    expect_ledgers(result, 1e-15);
    const double couple = 0.05 * 0.375 * pair.state.grains.mass[0], friction = 0.2 * 0.5 * pair.state.grains.mass[0];
    EXPECT_NEAR(pair.state.grains.spin[0], (couple - friction) / pair.inertia(0), 1e-13);
  }

  // A disc turns on a grain of the lower platen. The row of the contact is turned if the grain of the platen has the lower
  // number.
  TEST(Rolling, AGrainOfAPlatenBrakesADiscWhicheverNumberIsLower)
  {
    for (const bool platen_first : {true, false})
      {
        const double step            = 0.01;
        StepSetting  setting         = exact_setting(step, -g);
        setting.law.rolling_friction = mu_r;
        State state                  = disc_on_floor({0, 0});
        add_grain(state.grains, {0, 1.5}, 0.5, 1.);
        const int glued = platen_first ? 0 : 1, disc = 1 - glued;
        state.grains.position[glued] = {0, 0.5};
        state.grains.position[disc]  = {0, 1.5};
        state.grains.fixed[glued]    = lower_platen_grain;
        state.grains.spin[disc]      = 4;
        for (int k = 1; k <= 5; ++k)
          {
            const StepResult result = advance(state, setting);
            expect_ledgers(result, 1e-14);
            EXPECT_EQ(result.impulses[0].rolling > 0, platen_first) << "on the first body";
            EXPECT_NEAR(state.grains.spin[disc], 4 - 2 * mu_r * g * k * step / 0.5, 1e-12);
          }
      }
  }
} // namespace
