// diptych: tests that known bands are found, and none where there is none; their derivatives and strips
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/bands/band_detection.h"
#include "coupling/bands/band_projection.h"
#include "coupling/bands/strips.h"
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
    EXPECT_EQ(report.bands[0].is_diffuse, 2.197 * GetParam().half_width > 52 / 3.);
    EXPECT_EQ(report.verdict.find("; diffuse: ") != std::string::npos, report.bands[0].is_diffuse) << report.verdict;
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

  BandData noisy_data()
  {
    const SampleFrame frame = synthetic::frame_52_75();
    const auto        field = synthetic::grain_field(frame, {{-46, 6, 2, 0.9, 8}, {40, 5, -3, -0.4, 3}}, 0.2, 3, 500);
    return synthetic::band_data(field, frame);
  }

  // The shapes with parameter k (angle, offset, log half width of each band) changed by `step`.
  std::vector<BandShape> moved(std::vector<BandShape> shape, const int k, const double step)
  {
    BandShape &band = shape[k / 3];
    if (k % 3 == 0)
      band.angle += step;
    else if (k % 3 == 1)
      band.offset += step;
    else
      band.half_width *= std::exp(step);
    return shape;
  }

  // Away from the minimum and with noise of a fifth of the platen increment, so that the misfit matters. Central differences with
  // steps of 1e-4 have an error of (step^2/6) x third derivative. 1e-6 of the largest entry leaves a margin of a hundred.
  TEST(BandProjection, DerivativesAgreeWithDifferencesOfTheSumOfSquares)
  {
    const BandData data = noisy_data();
    for (const int n_bands : {1, 2})
      {
        std::vector<BandShape> shape = {{-0.7, 3, 5}, {0.8, -1, 7}};
        shape.resize(n_bands);
        const BandProjection p    = project_bands(data, data.w, shape);
        const double         step = 1e-4, scale = p.hessian.cwiseAbs().maxCoeff();
        for (int k = 0; k < 3 * n_bands; ++k)
          {
            const BandProjection up   = project_bands(data, data.w, moved(shape, k, step));
            const BandProjection down = project_bands(data, data.w, moved(shape, k, -step));
            EXPECT_NEAR(p.descent[k], -(up.sum_of_squares - down.sum_of_squares) / (4 * step), 1e-6 * scale) << k;
            for (int l = 0; l < 3 * n_bands; ++l)
              EXPECT_NEAR(p.hessian(l, k), -(up.descent[l] - down.descent[l]) / (2 * step), 1e-6 * scale) << k << l;
          }
      }
  }

  // Without a misfit both forms of the second derivative are equal.
  TEST(BandProjection, GaussNewtonIsExactWithoutMisfit)
  {
    BandData                     data  = noisy_data();
    const std::vector<BandShape> shape = {{-0.7, 3, 5}};
    for (std::size_t i = 0; i < data.x.size(); ++i)
      data.u[i] = Eigen::Vector2d(0.3, -0.2) * shape[0].profile(data.x[i]) + 0.01 * data.x[i];
    const BandProjection p = project_bands(data, data.w, shape);
    EXPECT_LT((p.hessian - p.gauss_newton).norm(), 1e-10 * p.hessian.norm());
    EXPECT_LT(p.descent.norm(), 1e-10 * p.hessian.norm());
    EXPECT_NEAR(p.coefficient(3, 0), 0.3, 1e-12);
    EXPECT_NEAR(p.coefficient(3, 1), -0.2, 1e-12);
  }

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
