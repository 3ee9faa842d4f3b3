// diptych: tests that known bands are found, and none where there is none
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/bands/band_detection.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/coupling/synthetic_samples.h"

namespace
{
  using namespace diptych::coupling;
  using synthetic::Truth;

  class BandOfKnownTruth : public testing::TestWithParam<Truth>
  {};

  TEST_P(BandOfKnownTruth, IsFoundWithoutNoise)
  {
    const auto report = find_bands(synthetic::grain_field(synthetic::frame_52_75(), {GetParam()}, 0, 1),
                                   synthetic::frame_52_75());
    ASSERT_EQ(report.bands.size(), 1u) << report.verdict;
    EXPECT_TRUE(report.converged);
    EXPECT_NEAR(report.bands[0].angle_deg, GetParam().angle_deg, 1e-4);
    EXPECT_NEAR(report.bands[0].half_width, GetParam().half_width, 1e-4);
    EXPECT_NEAR(report.bands[0].offset, GetParam().offset, 1e-4);
    EXPECT_NEAR(report.bands[0].jump, GetParam().jump, 1e-4);
    EXPECT_NEAR(report.bands[0].dilation_deg, GetParam().dilation_deg, 1e-2);
    EXPECT_NEAR(report.bands[0].width_10_90, 2.197225 * report.bands[0].half_width, 1e-5 * report.bands[0].half_width);
    EXPECT_NEAR(report.bands[0].r_squared, 1, 1e-6);
    EXPECT_NEAR(report.bands[0].r_squared_strips, 1, 1e-6);
  }

  // Nodes on a regular grid with area weights must give the same result.
  TEST_P(BandOfKnownTruth, IsTheSameOnNodesOfARegularGrid)
  {
    const SampleFrame frame  = synthetic::frame_52_75();
    const auto        report = find_bands(synthetic::node_field(frame, {GetParam()}, 52, 75), frame);
    ASSERT_EQ(report.bands.size(), 1u) << report.verdict;
    EXPECT_NEAR(report.bands[0].angle_deg, GetParam().angle_deg, 1e-4);
    EXPECT_NEAR(report.bands[0].half_width, GetParam().half_width, 1e-4);
    EXPECT_NEAR(report.bands[0].offset, GetParam().offset, 1e-4);
  }

  // {angle, half width, offset, jump, dilation}
  INSTANTIATE_TEST_SUITE_P(Synthetic,
                           BandOfKnownTruth,
                           testing::Values(Truth{-46, 6, 2, 0.9, 8},
                                           Truth{30, 3, -5, -0.8, 0},
                                           Truth{60, 5, 4, 0.7, -5},
                                           Truth{-60, 4, 0, 1, 12},
                                           Truth{-46, 10, 0, 1, 5},
                                           Truth{88, 4, 3, 0.8, 0},
                                           Truth{0, 4, -6, -0.9, 3}));

  // A frame 2^30 diameters wide would need 1e8 parallel lines of one angle.
  TEST(Band, RejectsAFrameLargerThanAnySample)
  {
    SampleFrame frame = synthetic::frame_52_75();
    frame.width       = 1 << 30;
    EXPECT_THROW((void)find_bands(synthetic::grain_field(synthetic::frame_52_75(), {}, 0.02, 41), frame), std::invalid_argument);
  }

  TEST(Band, AffineFieldIsDiffuse)
  {
    for (const double noise : {0., 0.02, 0.05, 0.2})
      {
        const auto report = find_bands(synthetic::grain_field(synthetic::frame_52_75(), {}, noise, 41), synthetic::frame_52_75());
        EXPECT_TRUE(report.bands.empty()) << noise << report.verdict;
        EXPECT_EQ(report.verdict.rfind("diffuse", 0), 0u);
      }
  }

  TEST(Band, RejectsInputThatCannotHoldABand)
  {
    SampleFrame frame = synthetic::frame_52_75();
    const auto  field = synthetic::grain_field(frame, {}, 0.02, 1, 20);
    EXPECT_THROW((void)find_bands(field, frame), std::invalid_argument);
    frame.platen_increment.setZero();
    EXPECT_THROW((void)find_bands(synthetic::grain_field(frame, {}, 0.02, 1), frame), std::invalid_argument);
  }
} // namespace
