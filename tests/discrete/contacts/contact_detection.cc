// diptych: every pair within reach is found, once, and the sweep order contains every contact once
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/contacts/contact_detection.h"
#include "discrete/contacts/contact_order.h"
#include "tests/common.h"
#include "tests/discrete/small_scenes.h"

namespace
{
  using namespace diptych::discrete;

  State random_grains(const int n, const double extent, const int seed)
  {
    std::mt19937 random(seed);
    const auto   uniform = [&](const double a, const double b) { return a + (b - a) * double(random()) / random.max(); };
    State        state;
    state.walls = {{{0, 0}, {0, 1}}, {{0, extent}, {0, -1}}};
    for (int i = 0; i < n; ++i)
      add_grain(state.grains, {uniform(0, extent), uniform(0, extent)}, uniform(0.1, 0.9), 1.);
    return state;
  }

  std::set<std::pair<int, int>> touching(const State &state, const std::vector<double> &margin)
  {
    std::set<std::pair<int, int>> pairs;
    const int                     n = int(state.grains.size());
    for (int i = 0; i < n; ++i)
      {
        for (int j = i + 1; j < n; ++j)
          if (make_contact(state, i, j).gap < margin[i] + margin[j])
            pairs.insert({i, j});
        for (int w = n; w < n + int(state.walls.size()); ++w)
          if (make_contact(state, i, w).gap < margin[i])
            pairs.insert({i, w});
      }
    return pairs;
  }

  // Sizes over four decades, distant clusters and fast grains between two platens, with and without a period. Cells then share
  // bins.
  TEST(ContactDetection, AgreesWithTheTestOfAllPairsForAnySizesAndPlaces)
  {
    std::mt19937 random(11);
    const auto   uniform = [&](const double a, const double b) { return a + (b - a) * double(random()) / random.max(); };
    std::size_t  n_found = 0;
    for (int trial = 0; trial < 40; ++trial)
      {
        State        state;
        const double apart = std::pow(10., uniform(0, 9)), spread = std::pow(10., uniform(0, 2));
        for (int i = 0; i < 300; ++i)
          add_grain(state.grains,
                    {uniform(0, spread) + apart * double(random() % 3), uniform(0, spread) - apart * double(random() % 2)},
                    std::pow(10., trial % 2 == 0 ? uniform(-3, 1) : uniform(-0.2, 0.2)), 1.);
        std::vector<double> margin(300, 0.01);
        margin[7]   = trial % 5 == 0 ? apart : 1;
        state.walls = {{{0, 0}, {0, 1}}, {{0, spread}, {0, -1}}};
        if (trial % 4 > 1)
          state.periodicity = PeriodicWidth{8 * (10 + 1.5 * margin[7] + 3) + spread};
        std::set<std::pair<int, int>> found;
        for (const Contact &c : find_contacts(state, margin))
          EXPECT_TRUE(found.insert({c.i, c.j}).second) << "twice";
        EXPECT_EQ(found, touching(state, margin)) << "trial " << trial;
        n_found += found.size();
      }
    EXPECT_GT(n_found, 10000u);
  }

  // A list that follows the strains of a sample stays right until it is made anew.
  TEST(ContactDetection, AListMayFollowAStrain)
  {
    State                     state = random_grains(300, 15, 5);
    const std::vector<double> margin(300, 0.01);
    NeighbourList             list;
    for (int k = 0; k < 40; ++k)
      {
        EXPECT_EQ(list.find_contacts(state, margin).size(), touching(state, margin).size()) << k;
        const UniformStrain strain{{4e-3, k % 7 == 0 ? -2e-2 : 3e-3}, {7, 0}};
        deform(state, strain);
        list.follow(strain);
      }
  }

  // A grain that crosses the period in a step could meet two images of another one. The message names the keys that help.
  TEST(ContactDetection, AStepTooLongForThePeriodIsRefused)
  {
    State state;
    add_grain(state.grains, {5, 5}, 0.5, 1.);
    state.periodicity = PeriodicWidth{10};
    EXPECT_TRUE(find_contacts(state, {1.}).empty());
    try
      {
        find_contacts(state, {2.});
        FAIL() << "not refused";
      }
    catch (const std::invalid_argument &error)
      {
        EXPECT_NE(std::string(error.what()).find("discrete/step"), std::string::npos) << error.what();
      }
  }

  // With a comparison of all pairs this would take minutes.
  TEST(ContactDetection, OneGrainFarAwayOrHugeDoesNotMakeAllPairsNear)
  {
    State state;
    for (int i = 0; i < 1000000; ++i)
      add_grain(state.grains, {i % 1000 + 0.5, i / 1000 + 0.5}, 0.5, 1.);
    add_grain(state.grains, {1e9, 1e9}, 0.5, 1.);
    add_grain(state.grains, {-700, 500}, 700, 1.);
    const std::size_t lattice = 2 * 999 * 1000, n = find_contacts(state, std::vector<double>(state.grains.size(), 1e-9)).size();
    EXPECT_GE(n, lattice);
    EXPECT_LE(n, lattice + 2); // the huge one touches the first column between two grains
  }

  // A list of millions of grains takes seconds. A request to stop the run must not wait for it.
  TEST(ContactDetection, AListThatIsNotWantedAnyMoreIsLeft)
  {
    const State               state = random_grains(20000, 140, 3);
    const std::vector<double> margin(20000, 0.05);
    NeighbourList             neighbours;
    int                       asked = 0;
    EXPECT_TRUE(neighbours.near_pairs(state, margin, [&] { return ++asked < 3; }).empty());
    EXPECT_EQ(asked, 3);
    EXPECT_EQ(neighbours.find_contacts(state, margin).size(), find_contacts(state, margin).size())
      << "an incomplete list was kept";
    EXPECT_EQ(asked, 3);
  }

  // Gap, normal and point of two discs of radii 0.5 and 1 whose centres are 2 apart along x.
  TEST(ContactDetection, GeometryOfAPairAndOfAWall)
  {
    State state;
    add_grain(state.grains, {2, 5}, 0.5, 1.);
    add_grain(state.grains, {0, 5}, 1.0, 1.);
    state.walls     = {{{0, 4.5}, {0, 1}}};
    const Contact c = make_contact(state, 0, 1);
    EXPECT_NEAR(c.gap, 0.5, 1e-15);
    EXPECT_NEAR((c.normal - Eigen::Vector2d(1, 0)).norm(), 0, 1e-15); // from j to i
    EXPECT_NEAR((c.point - Eigen::Vector2d(1.25, 5)).norm(), 0, 1e-15);
    const Contact w = make_contact(state, 0, 2);
    EXPECT_NEAR(w.gap, 0, 1e-15);
    EXPECT_NEAR((w.point - Eigen::Vector2d(2, 4.5)).norm(), 0, 1e-15);
  }

  using namespace diptych::tests;

  TEST(SweepOrder, IsAPermutationUpward)
  {
    const ShearedSample        sheared  = sheared_sample();
    const std::vector<Contact> contacts = find_contacts(sheared.state, std::vector<double>(sheared.state.grains.size(), 0.05));
    const std::vector<int>     order    = sweep_order(contacts, 1.);
    ASSERT_EQ(order.size(), contacts.size());
    EXPECT_EQ(std::set<int>(order.begin(), order.end()).size(), contacts.size());
    for (std::size_t k = 1; k < order.size(); ++k)
      EXPECT_GT(contacts[order[k]].point.y(), contacts[order[k - 1]].point.y() - 0.1) << "layers are a tenth of the length thick";
    for (const int row : order)
      EXPECT_TRUE(row >= 0 && row < int(contacts.size()));
  }

  // Grains on one line, or a very distant grain, must not require endless layers.
  TEST(SweepOrder, CopesWithOneLineAndWithFarFlungGrains)
  {
    EXPECT_TRUE(sweep_order({}, 1.).empty());
    std::vector<Contact> contacts(3, Contact{0, 1, 0, {0, 1}, {0, 2}});
    EXPECT_EQ(sweep_order(contacts, 1.), (std::vector<int>{0, 1, 2}));
    contacts[0].point.y() = 1e12;
    EXPECT_EQ(sweep_order(contacts, 1.), (std::vector<int>{1, 2, 0}));
  }
} // namespace
