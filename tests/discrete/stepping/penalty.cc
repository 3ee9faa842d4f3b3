// diptych: explicit smooth contacts: single discs in closed form
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tests/discrete/stepping/penalty_examples.h"

namespace
{
  // m_eff x'' = -kn x gives half a period pi sqrt(m_eff/kn), m_eff = m/2, and the reversed speed. The energy of the leapfrog
  // differs from the true one by a share of at most (omega h)^2/4, where omega h = sqrt(2) fraction. The speed differs by
  // fraction^2/4.
  TEST(Penalty, HeadOnCollisionWithoutDampingLastsHalfAPeriodAndKeepsTheSpeed)
  {
    const double stiffness = 1e5, half_period = M_PI * std::sqrt(0.5 * (M_PI / 4) / stiffness);
    for (const double fraction : {0.2, 0.1, 0.05, 0.01})
      {
        const Collision c    = head_on(stiffness, 0, fraction);
        const double    step = fraction * std::sqrt(M_PI / 4 / stiffness);
        EXPECT_NEAR(c.duration, half_period, 1.5 * step) << "fraction " << fraction;
        EXPECT_NEAR(c.restitution, 1, 0.25 * fraction * fraction) << "fraction " << fraction;
      }
  }

  // A dashpot that may pull until the overlap has vanished gives e = exp(-pi beta/sqrt(1-beta^2)). Grains do not pull, so contact
  // ends at f_n = 0, i.e. x'' = 0. This is at omega_d t = pi - 2a with beta = sin a, and e = exp(-(pi - 2a) tan a) (Schwager and
  // Poeschel 2007). The velocity of the dashpot lags by half a step, so the error is of first order.
  TEST(Penalty, HeadOnCollisionWithADashpotHasItsClosedRestitution)
  {
    for (const double beta : {0.1, 0.2, 0.5})
      {
        const double a = std::asin(beta), expected = std::exp(-(M_PI - 2 * a) * std::tan(a));
        EXPECT_GT(expected, std::exp(-M_PI * std::tan(a)));
        for (const double fraction : {0.1, 0.01})
          EXPECT_NEAR(head_on(1e5, beta, fraction).restitution, expected, 0.1 * fraction) << "beta " << beta;
      }
  }

  // kn overlap = m g.
  TEST(Penalty, DiscAtRestOnAFloorOverlapsByItsWeightOverTheStiffness)
  {
    const double stiffness = 1e4, g = 9.81;
    State        state = disc_on_floor({0, 0});
    Penalty      penalty(penalty_step(state.grains, stiffness, 0.2), stiffness, 0.2);
    penalty.setting.stepping.gravity_y = -g;
    StepResult result;
    for (int k = 0; k < 1500; ++k) // 300/(2 pi) periods: decays by exp(-0.2 x 300)
      result = penalty.advance(state);
    const double weight = state.grains.mass[0] * g;
    EXPECT_NEAR(result.largest_penetration, weight / stiffness, 1e-10 * weight / stiffness);
    EXPECT_NEAR(result.wall_force[0].y(), weight, 1e-10 * weight);
    EXPECT_NEAR(result.impulses[0].normal, weight * penalty.step, 1e-10 * weight);
  }

  // The tangential spring oscillates about its rest force m g sin(a)/3 with omega^2 = kt (1/m + 2/m), by at most 2 g sin(a)/omega
  // in speed. With the rolling spring of the same stiffness the slower of the two modes has omega^2 = kt (5 - sqrt(17))/(2 m).
  TEST(Penalty, DiscOnAnInclineRestsRollsOrSlidesUpToTheSwingOfItsSprings)
  {
    const double g = 9.81, radius = 0.5, stiffness = 1e7;
    const Slope  slopes[] = {{0.1, 0.2},      {0.2, 0.2},      {0.5, 0.2},     {0.6, 0.2},     {0.9, 0.2},
                             {0.1, 0.5, 0.2}, {0.5, 0.5, 0.2}, {1., 0.5, 0.1}, {0.4, 0.3, 0.5}}; // atan(0.6) = 0.5404
    for (const Slope &s : slopes)
      {
        const double slope = s.angle;
        State        state = disc_on_floor({0, 0}, radius);
        const double mass = state.grains.mass[0], time = 0.05;
        const int    n_steps = int(time / penalty_step(state.grains, stiffness, 0.1)) + 1;
        Penalty      penalty(time / n_steps, stiffness);
        tilt(penalty.setting, s, g);
        state.grains.position[0].y() -= mass * g * std::cos(slope) / stiffness; // at rest on its spring
        for (int k = 0; k < n_steps; ++k)
          ASSERT_EQ(penalty.advance(state).solve.status, SolveStatus::converged);
        const auto [acceleration, turning] = on_an_incline(s, g, radius);
        const double softness              = s.rolling > 0 ? 0.5 * (5 - std::sqrt(17.)) : 3;
        const double swing                 = 2 * g * std::sin(slope) / std::sqrt(softness * kt_over_kn * stiffness / mass);
        EXPECT_NEAR(state.grains.velocity[0].x(), acceleration * time, swing) << "slope " << slope;
        EXPECT_NEAR(state.grains.spin[0], -turning * time, 2 * swing / radius) << "slope " << slope;
      }
  }

  // Sum of kn overlap^2 / 2 at the positions at the end of the step.
  double elastic_energy(const State &state, const double stiffness)
  {
    double energy = 0;
    for (const Contact &c : find_contacts(state, std::vector<double>(state.grains.size(), 0.)))
      energy += 0.5 * stiffness * c.gap * c.gap;
    return energy;
  }

  // Radii 0.35 to 0.49 on a square grid, with random velocities in a box.
  State gas_in_a_box()
  {
    State                                  state;
    std::mt19937                           random(3);
    std::uniform_real_distribution<double> uniform(-1, 1);
    add_box(state, 5, 5);
    for (int k = 0; k < 16; ++k)
      {
        add_grain(state.grains, {1. + k % 4, 1. + k / 4}, 0.42 + 0.07 * uniform(random), 1.);
        state.grains.velocity[k] = {uniform(random), uniform(random)};
      }
    return state;
  }

  TEST(Penalty, FrictionlessUndampedDiscsKeepKineticPlusElasticEnergy)
  {
    const double stiffness = 1e4;
    State        state     = gas_in_a_box();
    Penalty      penalty(penalty_step(state.grains, stiffness, 0.05), stiffness);
    const double start    = kinetic_energy(state.grains);
    int          contacts = 0;
    for (int k = 0; k < 20000; ++k)
      {
        contacts += int(penalty.advance(state).contacts.size());
        ASSERT_NEAR(kinetic_energy(state.grains) + elastic_energy(state, stiffness), start, 1e-3 * start) << "step " << k;
      }
    EXPECT_GT(contacts, 20 * 50) << "at least twenty collisions of fifty steps each";
  }

  // A scene with friction, dashpots, gravity, a moving fixed grain, a platen free under pressure and a driven platen.
  State busy_scene()
  {
    State state              = gas_in_a_box();
    state.walls[1].drive_y   = AppliedPressure{2.};
    state.walls[1].mass      = 3;
    state.walls[3].drive_x   = PrescribedVelocity{{{0, 1}, {0, -0.2}}};
    state.grains.fixed[5]    = 1;
    state.grains.velocity[5] = {0.3, 0};
    state.grains.spin[5]     = 1;
    return state;
  }

  Penalty busy_penalty(const State &state)
  {
    Penalty penalty(penalty_step(state.grains, 1e3, 0.2), 1e3, 0.2);
    penalty.setting.law.friction        = 0.4;
    penalty.setting.law.platen_friction = 0.3;
    penalty.setting.stepping.gravity_y  = -1;
    return penalty;
  }

  // Impact: dashpots and elastic energy. The ledgers hold in each step, for any step length.
  TEST(Penalty, MomentumAndEnergyLedgersCloseToRoundOff)
  {
    State   state    = busy_scene();
    Penalty penalty  = busy_penalty(state);
    double  friction = 0;
    for (int k = 0; k < 3000; ++k)
      {
        const StepResult    result = penalty.advance(state);
        const StepEnergies &e      = result.energies;
        expect_ledgers(result, 1e-13 * e.kinetic);
        ASSERT_GE(e.friction_dissipation, 0);
        friction += e.friction_dissipation;
      }
    EXPECT_GT(friction, 0.1);
    EXPECT_EQ(state.grains.velocity[5], Eigen::Vector2d(0.3, 0));
    EXPECT_EQ(state.grains.spin[5], 1);
  }

  // Springs are part of the State and the pairs are a cache, so nothing else needs to be stored. The ledger only reads.
  TEST(Penalty, RunResumedFromItsStateWithoutLedgersGoesOnWithTheSameBits)
  {
    State   straight = busy_scene();
    Penalty penalty  = busy_penalty(straight);
    for (int k = 0; k < 1234; ++k)
      (void)penalty.advance(straight);
    State   resumed = straight;
    Penalty fresh   = busy_penalty(resumed);
    for (int k = 0; k < 1000; ++k)
      {
        (void)penalty.advance(straight);
        (void)fresh.advance(resumed, false);
      }
    EXPECT_EQ(straight.grains.position, resumed.grains.position);
    EXPECT_EQ(straight.grains.velocity, resumed.grains.velocity);
    EXPECT_EQ(straight.grains.spin, resumed.grains.spin);
    EXPECT_EQ(straight.walls[1].point, resumed.walls[1].point);
    const StepResult last = penalty.advance(straight), other = fresh.advance(resumed);
    EXPECT_EQ(last.contact_dissipation, other.contact_dissipation);
    EXPECT_FALSE(last.contacts.empty());
  }

  // The column transmits pressure x length to the floor. Each spring is compressed by its force / kn.
  TEST(Penalty, PlatenUnderPressureIsCarriedByTheColumnBelowIt)
  {
    const double stiffness = 1e4, pressure = 2, length = 1.5;
    State        state;
    state.walls            = {{{0, 0}, {0, 1}}, {{0, 3}, {0, -1}}};
    state.walls[1].drive_y = AppliedPressure{pressure, length};
    for (int k = 0; k < 3; ++k)
      add_grain(state.grains, {0., 0.5 + k}, 0.5, 1.);
    Penalty    penalty(penalty_step(state.grains, stiffness, 0.2), stiffness, 0.2);
    StepResult result;
    for (int k = 0; k < 20000; ++k)
      result = penalty.advance(state);
    EXPECT_NEAR(result.wall_force[0].y(), pressure * length, 1e-9);
    EXPECT_NEAR(result.wall_force[1].y(), -pressure * length, 1e-9);
    EXPECT_NEAR(state.walls[1].point.y(), 3 - 4 * pressure * length / stiffness, 1e-9);
  }

  // A row around the cell carries pressure x height in each of its n springs. At rest the width is n (d - P H / kn).
  TEST(Penalty, RowAroundACellOfFreeWidthCarriesItsPressure)
  {
    const double stiffness = 1e4, pressure = 2, height = 1.5;
    const int    n = 8;
    State        state;
    state.walls       = {{{0, -0.75}, {0, 1}}, {{0, 0.75}, {0, -1}}};
    state.periodicity = PeriodicWidth{double(n), 0., pressure, 2.};
    for (int k = 0; k < n; ++k)
      add_grain(state.grains, {double(k), 0.}, 0.5, 1.);
    Penalty    penalty(penalty_step(state.grains, stiffness, 0.2), stiffness, 0.2);
    StepResult result;
    for (int k = 0; k < 20000; ++k)
      result = penalty.advance(state);
    ASSERT_EQ(int(result.contacts.size()), n);
    for (const Impulse &r : result.impulses)
      EXPECT_NEAR(r.normal, penalty.step * pressure * height, 1e-9 * penalty.step);
    EXPECT_NEAR(state.width()->width, n * (1 - pressure * height / stiffness), 1e-9);
  }
} // namespace
