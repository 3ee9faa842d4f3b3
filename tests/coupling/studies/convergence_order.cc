// diptych: orders of convergence are found if they exist, and only then
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/studies/convergence_order.h"

#include <cmath>

#include <gtest/gtest.h>

namespace
{
  using namespace diptych::coupling;

  TEST(ConvergenceOrder, PowerLawsAreFoundWhateverTheUnit)
  {
    for (const double order : {0.5, 1., 2., 3.7})
      for (const double unit : {1e-6, 1., 1e5})
        {
          std::vector<double> h, values;
          for (const double one : {1., 0.5, 0.25, 0.125})
            h.push_back(unit * one), values.push_back(3 - 0.2 * std::pow(one, order));
          const auto fit = fit_convergence(h, values);
          ASSERT_TRUE(fit) << order << ' ' << unit;
          EXPECT_NEAR(fit->order, order, 0.006);
          EXPECT_NEAR(fit->limit, 3, 1e-3);
          EXPECT_NEAR(fit->coefficient * std::pow(unit, fit->order), -0.2, 2e-3);
        }
  }

  TEST(ConvergenceOrder, ThreePointsGiveRichardsonsLimit)
  {
    // v = 1 + 2 h^2 at h = 4, 2, 1: the limit is (4 v(1) - v(2)) / 3.
    const auto fit = fit_convergence({4, 2, 1}, {33, 9, 3});
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->order, 2, 1e-9);
    EXPECT_NEAR(fit->limit, 1, 1e-9);
  }

  TEST(ConvergenceOrder, WithoutAPowerLawThereIsNoOrder)
  {
    EXPECT_FALSE(fit_convergence({1, 2}, {1, 2})) << "two points fit any order";
    EXPECT_FALSE(fit_convergence({1, 2, 2}, {1, 2, 2.1})) << "two different steps";
    EXPECT_FALSE(fit_convergence({1, 2, 4}, {5, 5, 5})) << "nothing changes";
    EXPECT_FALSE(fit_convergence({6, 4, 3, 2, 1.5, 1}, {0.391, 0.399, 0.3995, 0.372, 0.376, 0.411})) << "scatter";
    EXPECT_FALSE(fit_convergence({1, 2, 4, 8}, {0, 10, 15, 17.5})) << "grows as h goes to 0: the least order is the best";
  }
} // namespace
