// diptych: tests of the strips of Moreau's figure
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/bands/strips.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/coupling/synthetic_samples.h"

namespace
{
  using namespace diptych::coupling;

  // At 45 degrees a box of 52 x 75 extends (52 + 75) / (2 sqrt 2) = 44.9 along the normal. +-30 around the band fits on one side
  // only.
  TEST(Strips, CoverThirtyDiametersOnEachSideAsFarAsTheSampleReaches)
  {
    const auto edges = strip_edges(synthetic::frame_52_75(), -45, 20);
    ASSERT_EQ(edges.size(), 17u);
    EXPECT_DOUBLE_EQ(edges.front(), -10);
    EXPECT_NEAR(edges.back(), (52 + 75) / (2 * std::sqrt(2.)), 1e-12);
    for (int k = 0; k < 16; ++k)
      EXPECT_NEAR(edges[k + 1] - edges[k], (edges.back() - edges.front()) / 16, 1e-12);
  }

  // Each strip's mean of the noiseless field is the profile at its middle, up to the profile's curvature.
  TEST(Strips, MeansFollowTheProfile)
  {
    const SampleFrame      frame = synthetic::frame_52_75();
    const synthetic::Truth truth = {-46, 6, 2, 0.9, 0};
    DisplacementField      field = synthetic::grain_field(frame, {truth}, 0, 1);
    for (std::size_t i = 0; i < field.position.size(); ++i)
      field.increment[i] = synthetic::band_displacement(truth, frame, field.position[i]);
    const auto strips = strip_means(field, frame, -46, strip_edges(frame, -46, 2));
    for (std::size_t k = 0; k < 16; ++k)
      {
        const double middle = 0.5 * (strips.edges[k] + strips.edges[k + 1]);
        EXPECT_NEAR(strips.mean[k], 0.45 * std::tanh((middle - 2) / 6), 0.02);
        EXPECT_LT(strips.deviation[k], 0.1);
        EXPECT_GT(strips.count[k], 50);
      }
  }

  TEST(Strips, EmptyStripHasNoMean)
  {
    DisplacementField field;
    field.position    = {{26, 37.5}, {26, 37.6}};
    field.increment   = {{1, 0}, {5, 5}};
    field.weight      = {1, 0};
    const auto strips = strip_means(field, synthetic::frame_52_75(), 0, {-2, -1, 1});
    EXPECT_TRUE(std::isnan(strips.mean[0]));
    EXPECT_EQ(strips.count[1], 1);
    EXPECT_NEAR(strips.mean[1], 1 / std::sqrt(0.5), 1e-14);
    EXPECT_EQ(strips.deviation[1], 0);
    EXPECT_THROW(strip_means(field, synthetic::frame_52_75(), 0, {1}), std::invalid_argument);
  }
} // namespace
