// diptych: removal of penetrations with friction, and the first guess of a step
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/contacts/contact_law.h"
#include "discrete/stepping/position_correction.h"
#include "discrete/stepping/step_problem.h"
#include "discrete/stepping/warm_start.h"
#include "tests/discrete/small_scenes.h"

namespace
{
  using namespace diptych::tests;

  // Bodies at rest without forces, as a step would pass them to the correction. Impulses by the pair's first grain and body.
  struct AtRest
  {
    State                     state;
    StepSetting               setting;
    std::vector<Contact>      contacts;
    ContactProblem            problem;
    std::vector<Impulse>      impulses;
    std::vector<BodyVelocity> v_new;

    explicit AtRest(const State &start, const double friction = 0.)
        : state(start),
          setting(exact_setting(0.1))
    {
      setting.law = same_friction(friction);
      contacts    = find_contacts(state, std::vector<double>(state.grains.size(), 0.02));
      v_new       = body_velocities(state);
      problem     = make_problem(state, setting, contacts, v_new, {v_new, {}, {}});
      impulses.resize(contacts.size());
    }

    // The impulses bring the free velocities of the problem to rest.
    void load(const int i, const int j, const Impulse &r)
    {
      for (std::size_t k = 0; k < contacts.size(); ++k)
        if (contacts[k].i == i && contacts[k].j == j)
          {
            impulses[k] = r;
            apply_impulse(problem.contacts[k], {-r.normal, -r.tangential}, problem.free_velocity);
          }
    }

    void correct(const double enough = 1e-9)
    {
      ThreadTeam one_thread(1);
      correct_positions(state, {problem, contacts, impulses, v_new, setting.step}, enough, one_thread);
    }
  };

  double gap_between(const State &state, const int i, const int j)
  {
    return make_contact(state, i, j).gap;
  }

  State overlapping_pair(const double overlap)
  {
    State state;
    add_grain(state.grains, {0, 0}, 0.5, 1.);
    add_grain(state.grains, {0.9 - overlap, 0}, 0.4, 1.);
    return state;
  }

  TEST(PositionCorrection, PartsAPairInProportionToTheInverseMassesAndLeavesVelocitiesAlone)
  {
    const double overlap = 0.01;
    AtRest       pair(overlapping_pair(overlap));
    const Grains before = pair.state.grains;
    pair.correct();
    const Grains &g = pair.state.grains;
    EXPECT_NEAR(gap_between(pair.state, 0, 1), 0, 1e-15);
    EXPECT_NEAR((g.position[0].x() - before.position[0].x()) * g.mass[0] +
                  (g.position[1].x() - before.position[1].x()) * g.mass[1],
                0, 1e-16);
    EXPECT_LT(g.position[0].x(), 0);
    EXPECT_EQ(g.velocity[0], before.velocity[0]);
    EXPECT_EQ(g.spin[1], before.spin[1]);
  }

  TEST(PositionCorrection, LeavesSmallPenetrations)
  {
    AtRest       pair(overlapping_pair(1e-4));
    const Grains before = pair.state.grains;
    pair.correct(2e-4);
    EXPECT_EQ(pair.state.grains.position[0], before.position[0]);
    EXPECT_EQ(pair.state.grains.position[1], before.position[1]);
  }

  TEST(PositionCorrection, WallsUnderAForceAndACellOfFreeWidthGiveWayFixedGrainsDoNot)
  {
    State wall            = disc_on_floor({0, 0});
    wall.walls[0].point   = {0, 0.01};
    wall.walls[0].mass    = wall.grains.mass[0];
    wall.walls[0].drive_y = AppliedForce{{{0.}, {1.}}};
    AtRest pressed(wall);
    pressed.correct();
    EXPECT_NEAR(pressed.state.walls[0].point.y(), 0.005, 1e-15);
    EXPECT_NEAR(pressed.state.grains.position[0].y(), 0.505, 1e-15);

    State ring       = overlapping_pair(-2);
    ring.periodicity = PeriodicWidth{2.9 + 0.9 - 0.01, 0, 1.,
                                     ring.grains.mass[0]}; // the second disc touches the image of the first
    AtRest       across(ring);
    const double width = across.state.width()->width;
    across.correct();
    EXPECT_GT(across.state.width()->width, width + 0.001);
    EXPECT_NEAR(gap_between(across.state, 0, 1), 0, 1e-15);

    State held           = overlapping_pair(0.01);
    held.grains.fixed[0] = 1;
    AtRest against(held);
    against.correct();
    EXPECT_EQ(against.state.grains.position[0], Eigen::Vector2d(0, 0));
    EXPECT_NEAR(gap_between(against.state, 0, 1), 0, 1e-15);
  }

  // A disc on a floor is pushed sideways by an overlapping neighbour of the same size. With a load and enough friction on the
  // floor it rolls without sliding. Without friction it slides without turning.
  TEST(PositionCorrection, ALoadedContactHoldsWithItsFriction)
  {
    for (const double friction : {0., 1e3})
      {
        State state = disc_on_floor({0, 0});
        add_grain(state.grains, {0.99, 0.5}, 0.5, 1.);
        state.grains.fixed[1] = 1;
        AtRest pushed(state, friction);
        for (ContactRow &row : pushed.problem.contacts)
          if (row.j == 1)
            row.friction = 0; // so that only the floor turns it
        pushed.load(0, 2, {1., 0.});
        pushed.correct();
        const double moved = pushed.state.grains.position[0].x(), turned = pushed.state.grains.rotation[0];
        EXPECT_LT(moved, -0.009) << friction;
        EXPECT_NEAR(moved + 0.5 * turned, friction > 0 ? 0. : moved, 1e-5) << friction; // along the floor
      }
  }

  // Two discs stacked on a floor. Their weights grew in the last step and continue to grow, so the guess is right without any
  // sweep.
  TEST(WarmStart, RunsAheadIfForcesGrowSteadily)
  {
    State state = disc_on_floor({0, 0});
    add_grain(state.grains, {0, 1.5}, 0.5, 1.);
    AtRest       stack(state);
    const double m = state.grains.mass[0], growth = 0.1;
    const auto   weight = [&](const double g) { // impulses of the contacts in their order: (0, 1), (0, floor)
      return std::vector<Impulse>{{m * g * stack.setting.step, 0}, {2 * m * g * stack.setting.step, 0}};
    };
    ASSERT_EQ(stack.contacts.size(), 2u);
    ASSERT_EQ(stack.contacts[0].j, 1);
    for (BodyVelocity &v : stack.problem.free_velocity)
      if (v.inverse_mass > 0)
        v.y = -(1 + growth) * stack.setting.step;
    std::vector<Impulse> guess = weight(1), change = weight(growth);
    extrapolate(stack.problem, change, guess);
    for (int k = 0; k < 2; ++k)
      EXPECT_NEAR(guess[k].normal, weight(1 + growth)[k].normal, 1e-15);
  }

  TEST(WarmStart, StaysIfForcesDoAndWithinTheCone)
  {
    AtRest       resting(disc_on_floor({0, 0}), 0.5);
    const double m = resting.state.grains.mass[0], step = resting.setting.step;
    ASSERT_EQ(resting.contacts.size(), 1u);
    resting.problem.free_velocity[0].y = -step;
    std::vector<Impulse> guess{{m * step, 0}};
    extrapolate(resting.problem, {{0.3 * m * step, 0}}, guess);
    EXPECT_NEAR(guess[0].normal, m * step, 1e-15) << "the law holds already";

    resting.problem.free_velocity[0].x = 10 * step; // needs friction to stay
    guess                              = {{m * step, 0.4 * m * step}};
    extrapolate(resting.problem, {{0, 0.2 * m * step}}, guess);
    EXPECT_LE(std::abs(guess[0].tangential), 0.5 * guess[0].normal);
  }

  TEST(WarmStart, ChangesAreThoseOfTheLastStepAndScaleWithTheSquareOfItsLength)
  {
    State state;
    state.impulses = {{0, 1, 3., 1., 0.5, -0.25}, {1, 2, 7., 2.}};
    scale_impulses(state, 0.5);
    EXPECT_EQ(state.impulses[0].normal, 1.5);
    EXPECT_EQ(state.impulses[0].normal_change, 0.125);
    EXPECT_EQ(state.impulses[0].tangential_change, -0.0625);
    std::vector<Contact> contacts(3);
    contacts[0].i = 0, contacts[0].j = 1, contacts[1].i = 0, contacts[1].j = 2, contacts[2].i = 1, contacts[2].j = 2;
    const auto [guess, change] = first_guess(state.impulses, contacts);
    EXPECT_EQ(change[0].tangential, -0.0625);
    EXPECT_EQ(change[1].normal, 0);
    EXPECT_EQ(change[2].normal, 0);
    EXPECT_EQ(guess[2].normal, 3.5);
  }
} // namespace
