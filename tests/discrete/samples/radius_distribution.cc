// diptych: radii follow their distribution, by number and by mass
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/samples/radius_distribution.h"
#include "discrete/files/text_file.h"
#include "tests/common.h"

namespace
{
  using namespace diptych::discrete;
  using namespace diptych::tests;

  double mean(const std::vector<double> &values)
  {
    return std::accumulate(values.begin(), values.end(), 0.) / double(values.size());
  }

  // Mass of discs with radii up to r / whole mass (mass ~ r^2).
  double mass_fraction(const std::vector<double> &radius, const double r)
  {
    double below = 0, all = 0;
    for (const double value : radius)
      {
        all += value * value;
        below += value <= r ? value * value : 0;
      }
    return below / all;
  }

  // A gap-graded curve without grains between 0.4 and 0.5.
  const RadiusTable gap_graded = {{0.2, 0.4, 0.5, 1.}, {0., 0.3, 0.3, 1.}};

  std::string fault_of(const RadiusDistribution &distribution, const RadiusScale scale = RadiusScale::as_given)
  {
    return refusal([&] { radius_quantiles(distribution, 10, scale); });
  }

  const Folder      gradings;
  const std::string grading = gradings / "grading.csv";

  RadiusTable read_table(const std::string &text)
  {
    write_text(grading, text);
    return read_radius_table(grading);
  }

  std::string file_complaint(const std::string &text)
  {
    return complaint(grading, [&] { read_table("radius,passing\n" + text); });
  }

  // Midpoint quantiles of a linear curve have exactly the mean of its ends: (0.3 + 0.7) / 2.
  TEST(RadiusDistribution, UniformByNumberHasTheMeanOfItsEnds)
  {
    const std::vector<double> radius = radius_quantiles(UniformByNumber{0.3, 0.7}, 1001, RadiusScale::mean_diameter_one);
    EXPECT_NEAR(mean(radius), 0.5, 1e-15 * 1001);
    // (k + 1/2)/n of the range: the outermost radii are half a spacing inside.
    EXPECT_DOUBLE_EQ(radius.front(), 0.3 + 0.4 * 0.5 / 1001);
    EXPECT_DOUBLE_EQ(radius.back(), 0.7 - 0.4 * 0.5 / 1001);
  }

  // Samples prepared before this file existed must keep their bits.
  TEST(RadiusDistribution, UniformByNumberIsTheFormulaOfOldSamples)
  {
    const std::vector<double> radius = radius_quantiles(UniformByNumber{0.3, 0.7}, 4000);
    for (int k = 0; k < 4000; ++k)
      EXPECT_EQ(radius[k], 0.3 + (0.7 - 0.3) * (k + 0.5) / 4000);
  }

  // Number density c/r^2 on [a, b]: 1 = c (1/a - 1/b), mean = c ln(b/a). Koksma's inequality bounds the error of n midpoint
  // quantiles by (b - a)/(2n).
  TEST(RadiusDistribution, UniformByMassHasTheMeanOfItsNumberDensity)
  {
    const double a = 0.2, b = 1.;
    for (const int n : {100, 1000, 10000})
      {
        const std::vector<double> radius = radius_quantiles(UniformByMass{a, b}, n);
        EXPECT_NEAR(mean(radius), std::log(b / a) / (1 / a - 1 / b), (b - a) / (2 * n));
        EXPECT_TRUE(std::is_sorted(radius.begin(), radius.end()));
        EXPECT_GE(radius.front(), a);
        EXPECT_LE(radius.back(), b);
      }
  }

  // 1/r falls linearly with the number below r, here from 5 to 1: at 1/4 and 3/4 it is 4 and 2.
  TEST(RadiusDistribution, UniformByMassIsInvertedExactly)
  {
    const std::vector<double> radius = radius_quantiles(UniformByMass{0.2, 1.}, 2);
    EXPECT_DOUBLE_EQ(radius[0], 0.25);
    EXPECT_DOUBLE_EQ(radius[1], 0.5);
  }

  // Koksma's inequality applies to r^2 cut off at r (variation at most 2 r^2, over the mean of r^2) and to the whole mass
  // (variation b^2, b = 1). The error is at most (r^2 + b^2/2) / sum r^2; it decreases as 1/n.
  TEST(RadiusDistribution, AGradingCurveIsReproducedToOneOverN)
  {
    for (const int n : {200, 2000, 20000})
      {
        const std::vector<double> radius = radius_quantiles(gap_graded, n);
        const double              mass   = std::inner_product(radius.begin(), radius.end(), radius.begin(), 0.);
        EXPECT_GT(mass, 0.05 * n); // the bound below is O(1/n), because every r^2 is at least 0.04
        for (const auto &[r, passing] : {std::pair(0.3, 0.15), {0.4, 0.3}, {0.45, 0.3}, {0.5, 0.3}, {0.75, 0.65}, {1., 1.}})
          EXPECT_NEAR(mass_fraction(radius, r), passing, 1.5 / mass) << "n = " << n << ", r = " << r;
        for (const double r : radius)
          EXPECT_TRUE(r <= 0.4 || r >= 0.5) << r;
      }
  }

  TEST(RadiusDistribution, AGradingCurveOfOnePieceIsUniformByMass)
  {
    EXPECT_EQ(radius_quantiles(RadiusTable{{0.2, 1.}, {0., 1.}}, 77), radius_quantiles(UniformByMass{0.2, 1.}, 77));
    // Points on a straight curve change only the round-off.
    const auto whole = radius_quantiles(UniformByMass{0.2, 1.}, 77),
               cut   = radius_quantiles(RadiusTable{{0.2, 0.4, 0.8, 1.}, {0., 0.25, 0.75, 1.}}, 77);
    for (int k = 0; k < 77; ++k)
      EXPECT_NEAR(whole[k], cut[k], 1e-13);
  }

  TEST(RadiusDistribution, FlatEndsOfAGradingCurveHoldNoGrains)
  {
    const std::vector<double> radius = radius_quantiles(RadiusTable{{0.1, 0.2, 0.4, 0.8}, {0., 0., 1., 1.}}, 1000);
    EXPECT_GE(radius.front(), 0.2);
    EXPECT_LE(radius.back(), 0.4);
  }

  TEST(RadiusDistribution, RescaledRadiiHaveTheMeanDiameterOneAndTheSameRatios)
  {
    for (const RadiusDistribution &distribution : {RadiusDistribution(UniformByMass{2., 10.}), RadiusDistribution(gap_graded)})
      {
        const auto scaled = radius_quantiles(distribution, 500, RadiusScale::mean_diameter_one),
                   given  = radius_quantiles(distribution, 500);
        EXPECT_NEAR(2 * mean(scaled), 1, 1e-14);
        EXPECT_NEAR(scaled.back() / scaled.front(), given.back() / given.front(), 1e-13);
      }
  }

  TEST(RadiusDistribution, EqualEndsGiveEqualGrains)
  {
    EXPECT_EQ(radius_quantiles(UniformByNumber{0.5, 0.5}, 3, RadiusScale::mean_diameter_one), std::vector<double>(3, 0.5));
    EXPECT_EQ(radius_quantiles(UniformByMass{0.25, 0.25}, 3, RadiusScale::mean_diameter_one), std::vector<double>(3, 0.5));
  }

  TEST(RadiusDistribution, AnInvalidDistributionIsRefusedByNameValueAndRange)
  {
    EXPECT_EQ(fault_of(UniformByNumber{0., 1.}), "smallest radius 0 is out of range; allowed: more than 0");
    EXPECT_EQ(fault_of(UniformByMass{0.5, 0.25}),
              "largest radius 0.25 is out of range; allowed: 0.5 (the smallest radius) or more");
    EXPECT_EQ(fault_of(UniformByNumber{0.25, 0.5}), "");
    EXPECT_EQ(fault_of(UniformByNumber{0.25, 0.5}, RadiusScale::mean_diameter_one),
              "smallest + largest radius is 0.75 mean diameters; allowed: 1, so that radii uniform by number have the mean "
              "diameter 1");
    EXPECT_EQ(fault_of(UniformByMass{NAN, 1.}), "smallest radius nan is out of range; allowed: more than 0");
    EXPECT_EQ(fault_of(RadiusTable{{1.}, {1.}}),
              "a grading curve with 1 radii and 1 values of passing; allowed: 2 or more of each");
    EXPECT_EQ(fault_of(RadiusTable{{1., 2.}, {0., 0.5}}),
              "grading curve, point 2: passing 0.5 is out of range; allowed: 1, at the largest radius");
    EXPECT_THROW(radius_quantiles(UniformByMass{0.5, 1.}, 0), std::invalid_argument);
  }

  TEST(RadiusTable, FractionsAndPerCentAreTheSameCurve)
  {
    const RadiusTable fractions = read_table("passing,radius\n0,0.2\n0.25,0.4\n1,1\n"),
                      per_cent  = read_table("radius,passing\n0.2,0\n0.4,25\n1,100\n");
    EXPECT_EQ(fractions.radius, (std::vector<double>{0.2, 0.4, 1.}));
    EXPECT_EQ(fractions.passing, (std::vector<double>{0., 0.25, 1.}));
    EXPECT_EQ(per_cent.radius, fractions.radius);
    EXPECT_EQ(per_cent.passing, fractions.passing);
  }

  TEST(RadiusTable, EveryFaultIsNamed)
  {
    EXPECT_EQ(complaint(grading, [] { read_table("radius\n1\n"); }), ", line 1: column 'passing' is missing");
    EXPECT_EQ(file_complaint("1,1\n"), ", line 2: a grading curve of one point; allowed: 2 or more");
    EXPECT_EQ(file_complaint("-1,0\n1,1\n"), ", line 2: column 'radius' = '-1' is out of range; allowed: more than 0");
    EXPECT_EQ(file_complaint("1,0\n2,0.5\n2,1\n"),
              ", line 4: column 'radius' = '2' is out of range; allowed: more than 2, the radius before it");
    EXPECT_EQ(file_complaint("1,0.1\n2,1\n"),
              ", line 2: column 'passing' = '0.1' is out of range; allowed: 0, at the smallest radius");
    EXPECT_EQ(file_complaint("1,0\n2,0.6\n3,0.5\n4,1\n"),
              ", line 4: column 'passing' = '0.5' is out of range; allowed: 0.6 (the passing before it) to 1");
    EXPECT_EQ(file_complaint("1,0\n2,-5\n4,100\n"),
              ", line 3: column 'passing' = '-5' is out of range; allowed: 0 (the passing before it) to 100");
    EXPECT_EQ(file_complaint("1,0\n2,60\n4,1\n"),
              ", line 3: column 'passing' = '60' is out of range; allowed: 0 (the passing before it) to 1");
    EXPECT_EQ(
      file_complaint("1,0\n2,99\n"),
      ", line 3: column 'passing' = '99' is out of range; allowed: at the largest radius 1 (fractions) or 100 (per cent)");
  }
} // namespace
