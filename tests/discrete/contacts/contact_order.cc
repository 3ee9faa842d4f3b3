// diptych: the sweep order contains every contact once, from the bottom upward
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <set>

#include "discrete/contacts/contact_order.h"
#include "tests/discrete/small_scenes.h"

namespace
{
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
