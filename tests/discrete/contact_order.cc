// diptych: the sweep order holds every contact once, in batches that share no grain
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <set>

#include <gtest/gtest.h>

#include "discrete/contact_order.h"
#include "tests/discrete/small_scenes.h"

namespace
{
  using namespace diptych::tests;

  TEST(SweepOrder, IsAPermutationWithMostlyIndependentBatches)
  {
    const ShearedSample           sheared  = sheared_sample();
    const std::vector<Contact>    contacts = find_contacts(sheared.state, std::vector<double>(sheared.state.grains.size(), 0.05));
    const std::vector<Contact>    ordered  = sweep_order(contacts, int(sheared.state.grains.size()));
    std::set<std::pair<int, int>> before, after;
    for (const Contact &c : contacts)
      before.insert({c.i, c.j});
    for (const Contact &c : ordered)
      after.insert({c.i, c.j});
    EXPECT_EQ(before, after);
    ASSERT_EQ(ordered.size(), contacts.size());

    int shared = 0;
    for (std::size_t k = 1; k < ordered.size(); ++k)
      shared += ordered[k].i == ordered[k - 1].i || ordered[k].i == ordered[k - 1].j || ordered[k].j == ordered[k - 1].i;
    EXPECT_LT(shared, 0.35 * double(ordered.size())) << "in unordered contacts nearly every neighbour shares a grain";
  }
} // namespace
