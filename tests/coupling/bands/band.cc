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

  // Angle within 0.3 degrees, half width within 5 %, offset within 0.5 diameters.
  void expect_band(const Band &band, const Truth &truth, const double angle_tolerance = 0.3, const double width_tolerance = 0.05)
  {
    EXPECT_NEAR(band.angle_deg, truth.angle_deg, angle_tolerance);
    EXPECT_NEAR(band.half_width, truth.half_width, width_tolerance * truth.half_width);
    EXPECT_NEAR(band.width_10_90, 2.197225 * band.half_width, 1e-5 * band.half_width);
    EXPECT_NEAR(band.offset, truth.offset, 0.5);
    EXPECT_NEAR(band.jump, truth.jump, 0.06 * std::abs(truth.jump));
    EXPECT_NEAR(band.dilation_deg, truth.dilation_deg, 3);
  }

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
    EXPECT_NEAR(report.bands[0].r_squared, 1, 1e-6);
    EXPECT_NEAR(report.bands[0].r_squared_strips, 1, 1e-6);
  }

  TEST_P(BandOfKnownTruth, IsFoundUnderNoise)
  {
    for (const double noise : {0.02, 0.05})
      for (const std::uint64_t seed : {11, 12})
        {
          const auto report = find_bands(synthetic::grain_field(synthetic::frame_52_75(), {GetParam()}, noise, seed),
                                         synthetic::frame_52_75());
          ASSERT_EQ(report.bands.size(), 1u) << report.verdict;
          EXPECT_TRUE(report.converged);
          // even the least squares estimate scatters: by 1.9 % in half width in the worst of these cases at 5 % noise
          expect_band(report.bands[0], GetParam(), 0.3, noise < 0.03 ? 0.05 : 0.08);
          EXPECT_GT(report.bands[0].r_squared, 0.9);
        }
  }

  // Nodes on a regular grid with area weights must give the same result.
  TEST_P(BandOfKnownTruth, IsTheSameOnNodesOfARegularGrid)
  {
    const SampleFrame frame = synthetic::frame_52_75();
    DisplacementField nodes;
    for (int r = 0; r <= 75; ++r)
      for (int c = 0; c <= 52; ++c)
        {
          const Eigen::Vector2d x = frame.centre + Eigen::Vector2d(c - 26, r - 37.5);
          nodes.position.push_back(x);
          nodes.increment.push_back(synthetic::band_displacement(GetParam(), frame, x));
          nodes.weight.push_back((r % 75 == 0 ? 0.5 : 1) * (c % 52 == 0 ? 0.5 : 1));
        }
    const auto report = find_bands(nodes, frame);
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

  TEST(Band, RattlersAndOutliersDoNotMoveIt)
  {
    const Truth truth = {-46, 6, 2, 0.9, 8};
    auto        field = synthetic::grain_field(synthetic::frame_52_75(), {truth}, 0.03, 5);
    for (std::size_t i = 0; i < field.position.size(); i += 25) // 4 % aberrant
      field.increment[i] += Eigen::Vector2d(1.5, 1);
    const auto report = find_bands(field, synthetic::frame_52_75());
    ASSERT_EQ(report.bands.size(), 1u) << report.verdict;
    expect_band(report.bands[0], truth);
  }

  TEST(Band, WeakConjugateBandDoesNotRotateTheMainOne)
  {
    const Truth main = {-46, 6, 2, 0.9, 5}, weak = {50, 4, -3, -0.2, 5};
    for (const std::uint64_t seed : {21, 22})
      {
        const auto report = find_bands(synthetic::grain_field(synthetic::frame_52_75(), {main, weak}, 0.03, seed),
                                       synthetic::frame_52_75());
        ASSERT_EQ(report.bands.size(), 2u) << report.verdict;
        expect_band(report.bands[0], main, 0.5, 0.05);
        EXPECT_NEAR(report.bands[1].angle_deg, weak.angle_deg, 2);
      }
  }

  TEST(Band, CrossingPairIsTwoBands)
  {
    const Truth a = {52, 4, 1, 0.6, 6}, b = {-50, 5, -2, -0.5, 6};
    const auto  report = find_bands(synthetic::grain_field(synthetic::frame_52_75(), {a, b}, 0.03, 31), synthetic::frame_52_75());
    ASSERT_EQ(report.bands.size(), 2u) << report.verdict;
    expect_band(report.bands[0], a, 0.6, 0.08);
    expect_band(report.bands[1], b, 0.6, 0.08);
  }

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

  // The noise is constant over blocks of 8 diameters, as for grains. There must be no band either.
  TEST(Band, CorrelatedNoiseIsDiffuse)
  {
    int found = 0;
    for (std::uint64_t seed = 1; seed <= 5; ++seed)
      {
        auto                         field = synthetic::grain_field(synthetic::frame_52_75(), {}, 0.02, seed);
        std::mt19937_64              random(100 + seed);
        std::vector<Eigen::Vector2d> block(200);
        for (auto &b : block)
          b = {0.05 * synthetic::normal(random), 0.05 * synthetic::normal(random)};
        for (std::size_t i = 0; i < field.position.size(); ++i)
          field.increment[i] += block[int(field.position[i].x() / 8) + 10 * int(field.position[i].y() / 8)];
        found += find_bands(field, synthetic::frame_52_75()).bands.size();
      }
    EXPECT_EQ(found, 0);
  }

  // Everything is scaled: lengths by 0.01, and displacements with them.
  TEST(Band, UnitsDoNotMatter)
  {
    const Truth truth = {-46, 6, 2, 0.9, 8};
    SampleFrame frame = synthetic::frame_52_75();
    auto        field = synthetic::grain_field(frame, {truth}, 0.03, 5);
    const auto  large = find_bands(field, frame);
    for (auto &x : field.position)
      x *= 0.01;
    for (auto &u : field.increment)
      u *= 1e-4;
    frame.centre *= 0.01;
    frame.width *= 0.01;
    frame.height *= 0.01;
    frame.mean_diameter *= 0.01;
    frame.platen_increment *= 1e-4;
    const auto small = find_bands(field, frame);
    ASSERT_EQ(small.bands.size(), 1u);
    EXPECT_NEAR(small.bands[0].angle_deg, large.bands[0].angle_deg, 1e-4);
    EXPECT_NEAR(small.bands[0].half_width, 0.01 * large.bands[0].half_width, 1e-6);
    EXPECT_NEAR(small.bands[0].jump, large.bands[0].jump, 1e-5);
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
