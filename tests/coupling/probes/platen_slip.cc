// diptych: traction and slip along a platen of made-up contacts with a known friction law
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/probes/platen_slip.h"
#include "tests/coupling/synthetic_samples.h"

namespace
{
  using namespace diptych;
  using namespace diptych::coupling;

  constexpr double mu = 0.18, L = 12.6;

  // Slip grows from the middle to both ends, up to v. Each traction and each slip has an error.
  std::vector<PlatenContact> contacts(const double v, const double noise, std::mt19937_64 &random)
  {
    std::vector<PlatenContact> all;
    for (int k = 0; k < 40; ++k)
      {
        const auto   error = [&] { return noise * synthetic::uniform(random, -1, 1); };
        const double x = k - 19.5, slip = v * x / 20;
        const double normal = synthetic::uniform(random, 0.5, 1.5);
        all.push_back({x, normal, -normal * (mu * std::tanh(slip / (mu * L)) + error()), slip + v * error()});
      }
    return all;
  }

  PlatenParts window(const double v, const double noise, const bool is_mirror_symmetric, std::mt19937_64 &random)
  {
    return platen_parts({contacts(v, noise, random), contacts(v, noise, random)}, is_mirror_symmetric, 20);
  }

  // A part holds two contacts of each platen with almost equal slip; without errors the fit is as good as this allows.
  TEST(PlatenSlip, FitFindsTheLawOfTheContacts)
  {
    std::mt19937_64 random(1);
    for (const bool symmetric : {false, true})
      {
        const PlatenFriction found = platen_friction({window(6, 0, symmetric, random), window(6, 0, symmetric, random)});
        EXPECT_NEAR(found.friction.value, mu, 0.01 * mu);
        EXPECT_NEAR(found.slip_length.value, L, 0.01 * L);
      }
  }

  // Of 40 intervals of 95 %, fewer than 35 hold the truth in 1 of 100 such tests.
  TEST(PlatenSlip, IntervalsHoldTheTruth)
  {
    int held = 0;
    for (unsigned int seed = 0; seed < 40; ++seed)
      {
        std::mt19937_64          random(seed);
        std::vector<PlatenParts> windows;
        for (int w = 0; w < 8; ++w)
          windows.push_back(window(6, 0.1, true, random));
        const Interval friction = platen_friction(windows).friction;
        held += friction.low < mu && mu < friction.high;
      }
    EXPECT_GE(held, 35);
  }

  // One contact to the right of the middle below and one to the left above are the same place, turned by half a turn.
  TEST(PlatenSlip, UpperPlatenIsTheLowerOneTurned)
  {
    const PlatenParts parts = platen_parts(
      {{{5, 1, -0.2, 3}, {-20, 0, 0, 0}, {20, 0, 0, 0}}, {{-5, 1, 0.2, -3}, {-20, 0, 0, 0}, {20, 0, 0, 0}}}, false, 4);
    EXPECT_NEAR(parts[2].normal, 2, 1e-12);
    EXPECT_NEAR(parts[2].shear, -0.4, 1e-12);
    EXPECT_NEAR(parts[2].slip, 3, 1e-12);
  }

  // Two grains on the platens. Slip is the displacement relative to a platen that moves itself.
  TEST(PlatenSlip, ContactsOfGrainsMoveRelativeToTheirPlaten)
  {
    discrete::Snapshot from, to;
    from.displacement            = {{0, 0}, {0.01, 0}};
    to.displacement              = {{0.02, 0}, {0.05, -0.01}};
    to.position                  = {{1, 0.5}, {2, 9.5}};
    to.progress                  = 0.01;
    to.upper_platen_displacement = {0.03, -0.02};
    to.window_forces             = {{0, 2, {1, 0}, {0, 1}, {-0.2, 3}}, {1, 3, {2, 10}, {0, -1}, {0.1, -4}}};
    const PlatenContacts both    = platen_contacts(from, to);
    const PlatenContact  lower = both.lower.at(0), upper = both.upper.at(0);
    EXPECT_NEAR(lower.slip, 2, 1e-12);
    EXPECT_NEAR(lower.normal, 3, 1e-12);
    EXPECT_NEAR(lower.shear, -0.2, 1e-12);
    EXPECT_NEAR(upper.slip, 1, 1e-12);
    EXPECT_NEAR(upper.normal, 4, 1e-12);
    EXPECT_EQ(both.upper.size(), 1u);
  }

  // Nodes of a platen that moves to the right by 0.03, in 1 % strain. Off the platens there is no force.
  TEST(PlatenSlip, NodesOfTheContinuumAreContacts)
  {
    continuum::Snapshot from, to;
    from.position             = {{1, 0}, {2, 10}, {3, 5}};
    from.displacement         = {{0, 0}, {0, 0}, {0, 0}};
    to.position               = {{1.02, 0}, {2.05, 9.99}, {4, 6}};
    to.displacement           = {{0.02, 0}, {0.05, -0.01}, {1, 1}};
    to.platen_force           = {{-0.2, 3}, {0.1, -4}, {0, 0}};
    to.progress               = 0.01;
    const auto [lower, upper] = platen_contacts(from, to, 0.03);
    ASSERT_EQ(lower.size() + upper.size(), 2u);
    EXPECT_NEAR(lower[0].slip, 2, 1e-12);
    EXPECT_NEAR(upper[0].slip, 2, 1e-12);
    EXPECT_NEAR(upper[0].normal, 4, 1e-12);
    EXPECT_NEAR(upper[0].shear, 0.1, 1e-12);
  }

  // Slip far below the slip length: the traction says nothing of its largest value.
  TEST(PlatenSlip, ProportionalTractionHasNoLaw)
  {
    std::mt19937_64 random(1);
    EXPECT_TRUE(std::isnan(platen_friction({window(0.2 * mu * L, 0, true, random)}).friction.value));
    EXPECT_FALSE(std::isnan(platen_friction({window(mu * L, 0, true, random)}).friction.value));
  }

  // Nothing slips: no law.
  TEST(PlatenSlip, WithoutSlipThereIsNoLaw)
  {
    const std::vector<PlatenContact> still = {{0, 1, 0.1, 0}, {1, 1, 0.1, 0}};
    EXPECT_TRUE(std::isnan(platen_friction({platen_parts({still, still}, false, 2)}).friction.value));
  }
} // namespace
