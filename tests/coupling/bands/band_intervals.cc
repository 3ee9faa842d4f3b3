// diptych: tests of the coverage of the intervals of bands
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/bands/band_detection.h"
#include "coupling/bands/band_intervals.h"
#include "coupling/bands/band_calibration.h"
#include "tests/coupling/synthetic_samples.h"

namespace
{
  using namespace diptych::coupling;
  using synthetic::Truth;

  const SampleFrame tall    = synthetic::frame_52_75();
  const Truth       oblique = {-46, 6, 2, 0.9, 8};

  DisplacementField noisy_field(const Truth &truth, const double length, const double noise, const std::uint64_t seed)
  {
    auto field = synthetic::grain_field(tall, {truth}, 0, seed);
    synthetic::add_correlated_noise(field, tall, length, noise, seed + 1000);
    return field;
  }

  BandFitOptions sample()
  {
    BandFitOptions options;
    options.width  = tall.width;
    options.height = tall.height;
    return options;
  }

  BandFit fitted(const BandData &data, const Truth &truth)
  {
    return fit_bands(data, {{truth.angle_deg * M_PI / 180, truth.offset, truth.half_width}}, sample());
  }

  bool always(const BandFit &, std::size_t)
  {
    return true;
  }

  double length(const Interval &interval)
  {
    return interval.high - interval.low;
  }

  // Noise of 5 % with one independent sample per 8 x 8 and per 10 x 10 d in turn. Of 100 intervals with a coverage of 95 %, 95 +-
  // 2.2 cover the truth; three deviations leave 88 or more. The intervals must not be too wide: normal intervals are 2 x 1.96
  // deviations long. They may be half as long again if the noise is shorter than the block, and because of the small number of
  // blocks.
  TEST(BandIntervals, CoverTheTruthUnderCorrelatedNoise)
  {
    constexpr int               n     = 100;
    const std::array<double, 5> truth = {
      {oblique.angle_deg, oblique.half_width, oblique.offset, oblique.jump, oblique.dilation_deg}};
    std::array<int, 5>    covered = {};
    std::array<double, 5> squares = {}, lengths = {};
    for (int k = 0; k < n; ++k)
      {
        const BandData                data      = synthetic::band_data(noisy_field(oblique, k % 2 ? 8 : 10, 0.05, k), tall);
        const BandIntervals           band      = band_intervals(data, fitted(data, oblique), sample(), {10, 120, 1}, always)[0];
        const std::array<Interval, 5> intervals = {{band.angle_deg, band.half_width, band.offset, band.jump, band.dilation_deg}};
        for (int q = 0; q < 5; ++q)
          {
            covered[q] += intervals[q].low <= truth[q] && truth[q] <= intervals[q].high;
            squares[q] += std::pow(intervals[q].value - truth[q], 2) / n;
            lengths[q] += length(intervals[q]) / n;
          }
      }
    for (int q = 0; q < 5; ++q)
      {
        EXPECT_GE(covered[q], 88) << q;
        EXPECT_LT(lengths[q], 1.5 * 2 * 1.96 * std::sqrt(squares[q])) << q;
      }
  }

  // Interval lengths of full refits to the same draws, with all points and newly found Huber weights.
  std::array<double, 3> full_lengths(const BandData &data, const BandFit &fit, const BootstrapOptions &bootstrap)
  {
    const double                       x = 0.5 * tall.width, y = 0.5 * tall.height;
    const Tiles                        tiles = tiles_over({{-x, -y}, {x, y}}, 0, bootstrap.block);
    std::array<std::vector<double>, 3> deviation;
    for (const std::vector<int> &drawn : resampled_blocks(tiles.count(), bootstrap))
      {
        BandData points;
        for (std::size_t i = 0; i < data.x.size(); ++i)
          if (const int times = drawn[tiles.tile(data.x[i])]; times > 0)
            {
              points.x.push_back(data.x[i]);
              points.u.push_back(data.u[i]);
              points.w.push_back(times * data.w[i]);
            }
        const BandNumbers from = band_numbers(fit, 0), to = band_numbers(fit_bands(points, fit.shape, sample()), 0);
        for (int k = 0; k < 3; ++k)
          deviation[k].push_back(to[k] - from[k]);
      }
    BandData weighted            = data;
    weighted.w                   = huber_weights(data, fit, sample());
    const auto            factor = bootstrap_factors(weighted, fit, tiles, bootstrap);
    std::array<double, 3> lengths;
    for (int k = 0; k < 3; ++k)
      lengths[k] = factor[0][k] * length(interval_from(0, deviation[k]));
    return lengths;
  }

  // A single draw moves a full refit and a cheap one by amounts that differ by up to a third of a deviation, because of weights
  // and cells. The 2.5 % quantile of 100 draws is the third of them: a fifth of a deviation at either end, or a tenth of the
  // length. The mean of three fields is accurate to 0.1/sqrt(3), and two deviations of that are 0.12.
  TEST(BandIntervals, CheapRefitsAgreeWithFullOnes)
  {
    std::array<double, 3> ratio = {};
    for (const std::uint64_t seed : {7, 8, 9})
      {
        const BandData              data      = synthetic::band_data(noisy_field(oblique, 9, 0.03, seed), tall);
        const BandFit               fit       = fitted(data, oblique);
        const BootstrapOptions      bootstrap = {10, 100, 3};
        const BandIntervals         cheap     = band_intervals(data, fit, sample(), bootstrap, always)[0];
        const std::array<double, 3> full      = full_lengths(data, fit, bootstrap);
        ratio[0] += length(cheap.angle_deg) * M_PI / 180 / full[0] / 3;
        ratio[1] += std::log(cheap.half_width.high / cheap.half_width.low) / full[1] / 3;
        ratio[2] += length(cheap.offset) / full[2] / 3;
      }
    for (const double r : ratio)
      EXPECT_NEAR(r, 1, 0.12);
  }

  // A fit without misfit is the same for every draw.
  TEST(BandIntervals, VanishWithoutNoise)
  {
    const BandReport report = find_bands(synthetic::grain_field(tall, {oblique}, 0, 1), tall);
    ASSERT_EQ(report.bands.size(), 1u);
    const BandIntervals &band = report.bands[0].interval;
    EXPECT_EQ(band.resamples, 200);
    EXPECT_EQ(band.lost_share, 0);
    // Cells of 2 d average the tanh. This leaves a misfit of (2^2/24) x the second derivative, at most 0.4 % of the jump here.
    EXPECT_LT(length(band.angle_deg), 0.1);
    EXPECT_LT(length(band.half_width), 0.1);
    EXPECT_LT(length(band.offset), 0.05);
    EXPECT_LT(length(band.jump), 0.01);
  }

  // The same seed gives the same bits. The fit itself does not depend on the seed.
  TEST(BandIntervals, AreAFunctionOfTheSeed)
  {
    const auto field = noisy_field(oblique, 9, 0.05, 3);
    const Band a = find_bands(field, tall, {}, 5).bands[0], b = find_bands(field, tall, {}, 5).bands[0],
               c = find_bands(field, tall, {}, 6).bands[0];
    EXPECT_EQ(a.interval.half_width.low, b.interval.half_width.low);
    EXPECT_EQ(a.interval.dilation_deg.high, b.interval.dilation_deg.high);
    EXPECT_NE(a.interval.half_width.low, c.interval.half_width.low);
    EXPECT_EQ(a.half_width, c.half_width);
    EXPECT_NEAR(length(c.interval.angle_deg), length(a.interval.angle_deg), 0.3 * length(a.interval.angle_deg));
  }

  TEST(BandIntervals, HoldTheReportedNumbers)
  {
    const auto field = noisy_field(oblique, 9, 0.05, 3);
    const Band band  = find_bands(field, tall).bands[0];
    for (const auto &[interval, value] : {std::pair(band.interval.angle_deg, band.angle_deg),
                                          {band.interval.half_width, band.half_width},
                                          {band.interval.width_10_90, band.width_10_90},
                                          {band.interval.offset, band.offset},
                                          {band.interval.jump, band.jump},
                                          {band.interval.dilation_deg, band.dilation_deg}})
      {
        EXPECT_EQ(interval.value, value);
        EXPECT_LT(interval.low, value);
        EXPECT_GT(interval.high, value);
      }
  }

  // For small noise everything is linear: twice the noise gives twice the interval. The width enters by its logarithm.
  TEST(BandIntervals, GrowWithTheNoise)
  {
    const auto of = [](const double noise) { return find_bands(noisy_field(oblique, 9, noise, 3), tall).bands[0].interval; };
    const BandIntervals small = of(0.015), large = of(0.03);
    EXPECT_NEAR(length(large.angle_deg) / length(small.angle_deg), 2, 0.2);
    EXPECT_NEAR(std::log(large.half_width.high / large.half_width.low) / std::log(small.half_width.high / small.half_width.low),
                2, 0.2);
  }

  // Lengths are scaled by 0.01 with the mean diameter, displacements by 1e-4. Lengths and their intervals scale with them; angles
  // and jumps do not.
  TEST(BandIntervals, UnitsDoNotMatter)
  {
    auto        field  = noisy_field(oblique, 9, 0.05, 3);
    SampleFrame sample = tall;
    const Band  large  = find_bands(field, sample).bands[0];
    for (auto &x : field.position)
      x *= 0.01;
    for (auto &u : field.increment)
      u *= 1e-4;
    sample.centre *= 0.01;
    sample.width *= 0.01;
    sample.height *= 0.01;
    sample.mean_diameter *= 0.01;
    sample.platen_increment *= 1e-4;
    const Band small = find_bands(field, sample).bands[0];
    EXPECT_NEAR(small.angle_deg, large.angle_deg, 1e-4);
    EXPECT_NEAR(small.half_width, 0.01 * large.half_width, 1e-6);
    EXPECT_NEAR(small.jump, large.jump, 1e-5);
    EXPECT_NEAR(length(small.interval.half_width), 0.01 * length(large.interval.half_width), 1e-5);
    EXPECT_NEAR(length(small.interval.offset), 0.01 * length(large.interval.offset), 1e-5);
    EXPECT_NEAR(length(small.interval.angle_deg), length(large.interval.angle_deg), 1e-3);
    EXPECT_NEAR(length(small.interval.jump), length(large.interval.jump), 1e-3);
  }

  // At 90 degrees the angle is folded, but the interval is not.
  TEST(BandIntervals, UprightBandHasAnUnbrokenInterval)
  {
    for (const std::uint64_t seed : {1, 2, 3})
      {
        const Band band = find_bands(noisy_field({90, 4, 3, 0.8, 0}, 9, 0.03, seed), tall).bands[0];
        EXPECT_NEAR(std::remainder(band.angle_deg - 90, 180), 0, 3);
        EXPECT_LT(band.interval.angle_deg.low, band.angle_deg);
        EXPECT_GT(band.interval.angle_deg.high, band.angle_deg);
        EXPECT_LT(length(band.interval.angle_deg), 10);
        EXPECT_LT(length(band.interval.offset), 5);
      }
  }

  // A transition that is almost too wide for a band, under strong noise: many resamples show none.
  TEST(BandIntervals, AreUnknownIfResamplesLoseTheBand)
  {
    const Truth         wide  = {-46, 20, 0, 0.9, 0};
    const BandData      data  = synthetic::band_data(noisy_field(wide, 10, 0.04, 9), tall);
    const BandFit       fit   = fitted(data, wide);
    const double        bound = largest_half_width(sample(), fit.shape[0].angle);
    const auto          holds = [&](const BandFit &refit, std::size_t) { return refit.shape[0].half_width < 0.999 * bound; };
    const BandIntervals band  = band_intervals(data, fit, sample(), {10, 100, 1}, holds)[0];
    EXPECT_GT(band.lost_share, 0.1);
    EXPECT_EQ(band.resamples, std::lround(100 * (1 - band.lost_share)));
    EXPECT_TRUE(std::isnan(band.half_width.low));
    EXPECT_TRUE(std::isnan(band.half_width.high));
    EXPECT_EQ(band.half_width.value, fit.shape[0].half_width);
  }

  TEST(BandIntervals, AreUnknownWithoutResamplesOrBlocks)
  {
    const auto  field = noisy_field(oblique, 9, 0.05, 3);
    BandOptions none, one_block;
    none.resamples               = 0;
    one_block.correlation_length = 60;
    for (const BandOptions &options : {none, one_block})
      for (const Band &band : find_bands(field, tall, options).bands)
        {
          EXPECT_EQ(band.interval.resamples, 0);
          EXPECT_TRUE(std::isnan(band.interval.lost_share));
          EXPECT_EQ(band.interval.angle_deg.value, band.angle_deg);
          EXPECT_TRUE(std::isnan(band.interval.angle_deg.low));
          EXPECT_TRUE(std::isnan(band.interval.half_width.high));
        }
  }

  // Blocks of one correlation length miss a part of the covariance for any number of blocks, so all factors are above 1.
  TEST(BandIntervals, BlocksAloneAreTooNarrow)
  {
    const BandData data    = synthetic::band_data(noisy_field(oblique, 9, 0.05, 3), tall);
    const Tiles    tiles   = tiles_over({{-26, -37.5}, {26, 37.5}}, 0, 10);
    const auto     factors = bootstrap_factors(data, fitted(data, oblique), tiles, {10, 200, 1});
    for (const double factor : factors[0])
      {
        EXPECT_GT(factor, 1.2);
        EXPECT_LT(factor, 2.2);
      }
  }
} // namespace
