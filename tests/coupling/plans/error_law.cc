// diptych: error estimates of a plan from a few runs
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/plans/error_law.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace
{
  using namespace diptych::coupling;

  TEST(ErrorLaw, ARuleHoldsUntilThereIsEvidence)
  {
    const Estimate rule = {1, 0.5};
    EXPECT_DOUBLE_EQ(improved(rule, {}).mean, 1);
    EXPECT_DOUBLE_EQ(improved(rule, {{0.02, 0.08, 0}, {0, 0.01, 0.01}}).mean, 1) << "evidence without information must not count";
    // Equal weights: half way between prior and measurement, with a smaller deviation than either.
    const Estimate equal = improved(rule, {{0.02, 0.04, 0.01}});
    EXPECT_NEAR(equal.mean, 1.5, 1e-12);
    EXPECT_NEAR(equal.deviation, 0.5 / std::sqrt(2.), 1e-12);
    const Estimate sure = improved(rule, {{0.02, 0.06, 1e-6}});
    EXPECT_NEAR(sure.mean, 3, 1e-6);
  }

  TEST(ErrorLaw, PowerLawsAreContinuedToTheirLimit)
  {
    for (const double order : {0.5, 1., 1.5, 2.})
      {
        std::vector<double> sizes, values;
        for (const double h : {4., 2., 1.})
          sizes.push_back(h), values.push_back(7 - 0.1 * std::pow(h, order));
        const Refinement r = refinement(sizes, values);
        EXPECT_TRUE(r.converges);
        EXPECT_NEAR(r.order, order, 1e-9);
        EXPECT_NEAR(error_at(r, 3), 0.1 * std::pow(3, order), 1e-9);
        EXPECT_NEAR(error_at(r, size_for(r, 0.07)), 0.07, 1e-12);
      }
    EXPECT_NEAR(refinement({2, 1}, {5, 5.3}).error, 0.3, 1e-12) << "two values: first order";
    EXPECT_TRUE(std::isnan(refinement({2}, {5}).error));
  }

  TEST(ErrorLaw, ChangesThatGrowOrVanishByChanceAreNotConvergence)
  {
    const Refinement grows = refinement({4, 2, 1}, {1, 1.1, 1.25});
    EXPECT_FALSE(grows.converges);
    EXPECT_GT(grows.error, 0.15) << "the limit is at least the last change away";
    // 1, 1.1, 1.1: the last change is not a measure of the error.
    EXPECT_GT(refinement({4, 2, 1}, {1, 1.1, 1.1 + 1e-9}).error, 0.25 * 0.1 / 3 - 1e-9);
    EXPECT_EQ(refinement({4, 2, 1}, {1, 1, 1}).error, 0);
    EXPECT_EQ(refinement({4, 2, 1}, {1, 1, 1}).sign, 0);
    EXPECT_EQ(refinement({2, 1}, {5, 5.3}).sign, -1) << "coarse values lie below the limit";
    EXPECT_EQ(refinement({2, 1}, {5, 4.9}).sign, 1);
    EXPECT_EQ(size_for(refinement({4, 2, 1}, {1, 1, 1}), 0.01), std::numeric_limits<double>::infinity());
  }

  TEST(ErrorLaw, NumbersOfSamplesAreTheLeastThatSuffice)
  {
    EXPECT_NEAR(half_interval(1, 4), 3.182446 / 2, 1e-6) << "Student's table: t(0.975, 3)";
    for (const double half : {0.05, 0.2, 0.5, 1., 3.})
      {
        const int n = samples_for(1, half);
        ASSERT_GT(n, 0);
        EXPECT_LE(half_interval(1, n), half);
        EXPECT_TRUE(n == 1 || half_interval(1, n - 1) > half);
      }
    EXPECT_EQ(samples_for(1, 3.2), 1);
    EXPECT_EQ(samples_for(1, 1e-6), 0);
    EXPECT_EQ(samples_for(1, 0), 0);
    EXPECT_EQ(samples_for(1, -1), 0);
    EXPECT_EQ(samples_for(NAN, 1), 0) << "the scatter is unknown";
  }
} // namespace
