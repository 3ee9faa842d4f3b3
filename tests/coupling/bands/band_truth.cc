// diptych: tests of the accuracy of bands under noise, outliers and other bands, and of its limits
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/bands/band_detection.h"

#include <Eigen/LU>

#include "tests/coupling/synthetic_samples.h"

namespace
{
  using namespace diptych::coupling;
  using synthetic::Truth;

  const SampleFrame frame = synthetic::frame_52_75();

  BandReport found(const DisplacementField &field, const SampleFrame &sample = frame)
  {
    BandOptions options;
    options.resamples = 0;
    return find_bands(field, sample, options);
  }

  // Deviations from the truth, for the band that is nearest to it.
  struct Misses
  {
    double angle_deg, width, offset; // [degrees], share of the half width, [mean diameters]
  };

  Misses misses(const BandReport &report, const Truth &truth)
  {
    const auto angle   = [&](const Band &b) { return std::remainder(b.angle_deg - truth.angle_deg, 180); };
    const Band nearest = *std::min_element(report.bands.begin(), report.bands.end(), [&](const Band &a, const Band &b) {
      return std::abs(angle(a)) + std::abs(a.offset - truth.offset) < std::abs(angle(b)) + std::abs(b.offset - truth.offset);
    });
    return {angle(nearest), nearest.half_width / truth.half_width - 1, nearest.offset - truth.offset};
  }

  // The requirement: angle within 0.3 degrees and half width within 5 %.
  bool is_met(const Misses &m)
  {
    return std::abs(m.angle_deg) < 0.3 && std::abs(m.width) < 0.05;
  }

  // Standard deviations of angle, half width and offset of the weighted least squares fit of one band: A^-1 B A^-1 with A = sum w
  // J^T J and B = sum_ij w_i w_j C_ij J_i^T J_j. C is the covariance of the noise, white (length 0) or exp(-pi r^2/length^2). The
  // band slides along itself; J comes from differences of the truth.
  Misses expected_scatter(const DisplacementField &field, const Truth &truth, const double noise, const double length)
  {
    const int       n = field.position.size();
    Eigen::MatrixXd jacobian(n, 7);
    for (int i = 0; i < n; ++i)
      {
        const Eigen::Vector2d x     = field.position[i];
        const auto            shift = [&](Truth up, Truth down, const double step) {
          Band axes;
          axes.angle_deg  = truth.angle_deg;
          up.dilation_deg = down.dilation_deg = 0;
          const Eigen::Vector2d slope         = (synthetic::band_displacement(up, frame, x) -
                                         synthetic::band_displacement(down, frame, x)) /
                                        (2 * step);
          return slope.dot(axes.direction()) / frame.platen_increment.norm();
        };
        const double e = 1e-4;
        Truth        a = truth, b = truth;
        a.angle_deg += e, b.angle_deg -= e;
        jacobian(i, 0) = shift(a, b, e);
        a = b          = truth, a.half_width *= 1 + e, b.half_width *= 1 - e;
        jacobian(i, 1) = shift(a, b, e);
        a = b          = truth, a.offset += e, b.offset -= e;
        jacobian(i, 2) = shift(a, b, e);
        a = b          = truth, a.jump += e, b.jump -= e;
        jacobian(i, 3) = shift(a, b, e);
        jacobian.row(i).tail<3>() << 1, x.x() - frame.centre.x(), x.y() - frame.centre.y();
      }
    const Eigen::MatrixXd weighted = Eigen::Map<const Eigen::VectorXd>(field.weight.data(), n).asDiagonal() * jacobian;
    const Eigen::MatrixXd inverse  = (jacobian.transpose() * weighted).inverse();
    Eigen::MatrixXd       middle   = weighted.transpose() * weighted;
    if (length > 0)
      {
        middle.setZero();
        for (int i = 0; i < n; ++i)
          {
            Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(7);
            for (int j = 0; j < n; ++j)
              row += std::exp(-M_PI * (field.position[i] - field.position[j]).squaredNorm() / (length * length)) *
                     weighted.row(j);
            middle += weighted.row(i).transpose() * row;
          }
      }
    const Eigen::VectorXd deviation = noise * (inverse * middle * inverse).diagonal().cwiseSqrt();
    return {deviation[0], deviation[1], deviation[2]};
  }

  class NoisyBand : public testing::TestWithParam<Truth>
  {
  protected:
    // Root mean squares of the deviations over realisations must equal the expectation for least squares. For 24 realisations
    // such a root scatters by 1/sqrt(48) = 14 %; three deviations are 43 %. The noise is chosen so that the limits lie at two
    // expected deviations or more, and 95 % or more meet them. 20 of 24 is two and a half deviations below.
    void check(const double noise, const double length) const
    {
      constexpr int     n = 24;
      DisplacementField field;
      Misses            squares = {0, 0, 0};
      int               n_met   = 0;
      for (int k = 0; k < n; ++k)
        {
          field = synthetic::grain_field(frame, {GetParam()}, length > 0 ? 0 : noise, 100 + k);
          if (length > 0)
            synthetic::add_correlated_noise(field, frame, length, noise, 200 + k);
          const BandReport report = found(field);
          ASSERT_EQ(report.bands.size(), 1u) << report.verdict;
          const Misses m = misses(report, GetParam());
          squares.angle_deg += m.angle_deg * m.angle_deg / n;
          squares.width += m.width * m.width / n;
          squares.offset += m.offset * m.offset / n;
          n_met += is_met(m);
        }
      const Misses expected = expected_scatter(field, GetParam(), noise, length);
      EXPECT_LT(expected.angle_deg, 0.15);
      EXPECT_LT(expected.width, 0.025);
      EXPECT_GE(n_met, 20);
      EXPECT_NEAR(std::sqrt(squares.angle_deg), expected.angle_deg, 0.43 * expected.angle_deg);
      EXPECT_NEAR(std::sqrt(squares.width), expected.width, 0.43 * expected.width);
      EXPECT_NEAR(std::sqrt(squares.offset), expected.offset, 0.43 * expected.offset);
    }
  };

  TEST_P(NoisyBand, ScattersAsLeastSquaresUnderWhiteNoise)
  {
    check(0.05, 0);
  }

  TEST_P(NoisyBand, ScattersAsLeastSquaresUnderCorrelatedNoise)
  {
    check(0.0075, 8);
  }

  INSTANTIATE_TEST_SUITE_P(Synthetic,
                           NoisyBand,
                           testing::Values(Truth{-46, 6, 2, 0.9, 0}, Truth{30, 3, -5, -0.8, 0}, Truth{-45, 9, 1, 1.05, 0}));

  // The residuals of grains are 4 to 6 % of the platen's increment, with one independent sample per 8 to 10 d.
  TEST(BandTruth, NumberOfBandsIsRightUnderTheNoiseOfGrains)
  {
    const std::vector<std::vector<Truth>> cases = {
      {}, {{-45, 9, 1, 1.05, 3}}, {{-46, 6, 2, 0.9, 5}, {50, 4, -3, -0.27, 5}}, {{52, 4, 1, 0.6, 6}, {-50, 5, -2, -0.5, 6}}};
    for (const auto &truth : cases)
      for (int k = 0; k < 6; ++k)
        {
          auto field = synthetic::grain_field(frame, truth, 0, 300 + k);
          synthetic::add_correlated_noise(field, frame, k % 2 ? 8 : 10, 0.05, 400 + k);
          const BandReport report = found(field);
          EXPECT_EQ(report.bands.size(), truth.size()) << k << report.verdict;
        }
  }

  // One noise with and without a crossing band of 30 % of the jump. The main band's fit differs only by the effect of five
  // more unknowns. Single shifts scatter by 0.06 degrees and 0.3 %; the mean of eight scatters by a third of that.
  TEST(BandTruth, WeakConjugateBandDoesNotBiasTheMainOne)
  {
    const Truth   main = {-46, 6, 2, 0.9, 5}, weak = {50, 4, -3, -0.27, 5};
    constexpr int n     = 8;
    Misses        shift = {0, 0, 0};
    for (int k = 0; k < n; ++k)
      {
        auto alone = synthetic::grain_field(frame, {main}, 0, 300 + k);
        auto both  = synthetic::grain_field(frame, {main, weak}, 0, 300 + k);
        for (DisplacementField *field : {&alone, &both})
          synthetic::add_correlated_noise(*field, frame, 8, 0.02, 400 + k);
        const BandReport of_both = found(both);
        ASSERT_EQ(of_both.bands.size(), 2u) << of_both.verdict;
        const Misses with = misses(of_both, main), without = misses(found(alone), main);
        shift.angle_deg += (with.angle_deg - without.angle_deg) / n;
        shift.width += (with.width - without.width) / n;
      }
    EXPECT_NEAR(shift.angle_deg, 0, 0.07);
    EXPECT_NEAR(shift.width, 0, 0.004);
  }

  // Noise of 2 %, and 5 % of the grains with increments of up to three platen increments.
  TEST(BandTruth, AberrantGrainsDoNotMoveTheBand)
  {
    const Truth truth = {-46, 6, 2, 0.9, 8};
    for (const std::uint64_t seed : {1, 2, 3, 4})
      {
        auto field = synthetic::grain_field(frame, {truth}, 0.02, 500 + seed);
        synthetic::add_outliers(field, frame, 0.05, 600 + seed);
        const BandReport report = found(field);
        ASSERT_EQ(report.bands.size(), 1u) << report.verdict;
        EXPECT_TRUE(is_met(misses(report, truth))) << seed;
      }
  }

  TEST(BandTruth, BothBandsOfACrossAreFound)
  {
    const std::vector<Truth> cross = {{52, 4, 1, 0.6, 6}, {-50, 5, -2, -0.5, 6}};
    for (const std::uint64_t seed : {1, 2, 3})
      {
        const BandReport report = found(synthetic::grain_field(frame, cross, 0.02, 700 + seed));
        ASSERT_EQ(report.bands.size(), 2u) << report.verdict;
        for (const Truth &truth : cross)
          EXPECT_TRUE(is_met(misses(report, truth))) << seed << truth.angle_deg;
      }
    const BandReport nodes = found(synthetic::node_field(frame, cross, 26, 37));
    ASSERT_EQ(nodes.bands.size(), 2u) << nodes.verdict;
    for (const Truth &truth : cross)
      {
        const Misses m = misses(nodes, truth);
        EXPECT_NEAR(m.angle_deg, 0, 1e-4);
        EXPECT_NEAR(m.width, 0, 1e-5);
        EXPECT_NEAR(m.offset, 0, 1e-4);
      }
  }

  // The corner lies 44.7 d from the centre along the normal of a band at -46 degrees: 26 cos 44 + 37.5 cos 46. At an offset of 30
  // d the band cuts off a triangle of 6 % of the area. At 38 d it is 1 %, and only the number of bands is tested.
  TEST(BandTruth, BandsThatCutACornerOffAreFound)
  {
    const Truth near = {-46, 4, 30, 0.9, 5}, far = {-46, 4, 38, 0.9, 5};
    for (const std::uint64_t seed : {1, 2, 3})
      {
        const BandReport report = found(synthetic::grain_field(frame, {near}, 0.02, 800 + seed));
        ASSERT_EQ(report.bands.size(), 1u) << report.verdict;
        EXPECT_TRUE(is_met(misses(report, near))) << seed;
        EXPECT_EQ(found(synthetic::grain_field(frame, {far}, 0.02, 800 + seed)).bands.size(), 1u);
      }
  }

  // Platens move down, sideways or up; samples are tall, squat or small.
  TEST(BandTruth, FrameDoesNotMatter)
  {
    const std::vector<SampleFrame> frames = {synthetic::frame_of(40, 80, {0, -0.5}), synthetic::frame_of(75, 52, {0.7, -0.7}),
                                             synthetic::frame_of(60, 60, {0.3, 0}), synthetic::frame_of(60, 60, {0, 2})};
    for (const SampleFrame &sample : frames)
      for (const Truth &truth : {Truth{58, 4, 2, 0.8, 5}, Truth{-40, 5, 3, -0.9, 0}})
        {
          const BandReport report = found(synthetic::grain_field(sample, {truth}, 0.02, 900), sample);
          ASSERT_EQ(report.bands.size(), 1u) << report.verdict;
          EXPECT_TRUE(is_met(misses(report, truth))) << truth.angle_deg;
          EXPECT_NEAR(report.bands[0].jump, truth.jump, 0.03);
        }
  }

  void expect_same_band(const Band &a, const Band &b, const double turn = 0)
  {
    EXPECT_NEAR(b.angle_deg, a.angle_deg + turn, 0.01);
    EXPECT_NEAR(b.half_width, a.half_width, 1e-3);
    EXPECT_NEAR(b.offset, a.offset, 1e-3);
    EXPECT_NEAR(b.jump, a.jump, 1e-3);
    EXPECT_NEAR(b.dilation_deg, a.dilation_deg, 0.01);
  }

  // A quarter turn of everything rotates the band by 90 degrees. The fit ends within its tolerance of 1e-4.
  TEST(BandTruth, QuarterTurnRotatesTheBandByNinetyDegrees)
  {
    const SampleFrame     square       = synthetic::frame_of(60, 60, {0.5, -0.5});
    const auto            field        = synthetic::grain_field(square, {{-50, 5, 3, 0.8, 6}}, 0.03, 1000);
    const Eigen::Matrix2d turn         = (Eigen::Matrix2d() << 0, -1, 1, 0).finished();
    SampleFrame           turned_frame = square;
    DisplacementField     turned       = field;
    turned_frame.platen_increment      = turn * square.platen_increment;
    for (Eigen::Vector2d &x : turned.position)
      x = square.centre + turn * (x - square.centre);
    for (Eigen::Vector2d &u : turned.increment)
      u = turn * u;
    const BandReport a = found(field, square), b = found(turned, turned_frame);
    ASSERT_EQ(a.bands.size(), 1u);
    ASSERT_EQ(b.bands.size(), 1u);
    // From -50 to 40 degrees the normal (sin 50, cos 50) becomes (-sin 40, cos 40), which is the rotated normal.
    expect_same_band(a.bands[0], b.bands[0], 90);
  }

  TEST(BandTruth, MirroredSampleFoldsToTheSameBand)
  {
    const SampleFrame vertical = synthetic::frame_of(40, 80, {0, -0.5});
    const auto        field    = synthetic::grain_field(vertical, {{57, 4, 3, 0.7, 6}}, 0.03, 1100);
    DisplacementField mirrored = field;
    for (std::size_t i = 0; i < field.position.size(); ++i)
      {
        mirrored.position[i].x()  = 2 * vertical.centre.x() - field.position[i].x();
        mirrored.increment[i].x() = -field.increment[i].x();
      }
    const BandReport a = found(field, vertical), b = found(mirrored, vertical);
    ASSERT_EQ(a.bands.size(), 1u);
    ASSERT_EQ(b.bands.size(), 1u);
    EXPECT_LT(b.bands[0].angle_deg, -56);
    EXPECT_NEAR(folded(a.bands[0]).angle_deg, a.bands[0].angle_deg, 0); // already leans to the right
    expect_same_band(folded(a.bands[0]), folded(b.bands[0]));
  }

  TEST(BandTruth, FoldingMirrorsTheIntervals)
  {
    Band band;
    band.angle_deg = -50, band.jump = -0.8, band.offset = 3;
    band.interval.angle_deg = {-50, -53, -48};
    band.interval.jump      = {-0.8, -0.9, -0.75};
    band.interval.offset    = {3, 2, 5};
    const Band right        = folded(band);
    EXPECT_EQ(right.angle_deg, 50);
    EXPECT_EQ(right.jump, 0.8);
    EXPECT_EQ(right.interval.angle_deg.low, 48);
    EXPECT_EQ(right.interval.angle_deg.high, 53);
    EXPECT_EQ(right.interval.jump.low, 0.75);
    EXPECT_EQ(right.interval.jump.high, 0.9);
    EXPECT_EQ(right.offset, 3);
    EXPECT_EQ(right.interval.offset.low, 2);
    EXPECT_EQ(folded(right).angle_deg, 50); // a second folding changes nothing
  }

  // Shear of the whole sample with correlated noise, and a transition of 2 x 30 d over a sample that extends 45 d from its
  // middle.
  TEST(BandTruth, FieldsWithoutABandAreDiffuse)
  {
    for (const SampleFrame &sample : {frame, synthetic::frame_of(40, 80, {0, -0.5}), synthetic::frame_of(37, 53, {0.5, -0.5})})
      for (const double length : {8., 10.})
        for (const double noise : {0.03, 0.1})
          {
            auto field = synthetic::grain_field(sample, {}, 0, 1200);
            synthetic::add_correlated_noise(field, sample, length, noise, 1300 + length);
            for (std::size_t i = 0; i < field.position.size(); ++i)
              field.increment[i].x() += 0.8 * sample.platen_increment.norm() * field.position[i].y() / sample.height;
            EXPECT_TRUE(found(field, sample).bands.empty()) << sample.width << ' ' << length << ' ' << noise;
          }
    for (const std::uint64_t seed : {1, 2, 3})
      {
        auto field = synthetic::grain_field(frame, {{-46, 30, 2, 0.9, 5}}, 0.05, 1400 + seed);
        EXPECT_EQ(found(field).verdict.rfind("diffuse", 0), 0u);
      }
  }
} // namespace
