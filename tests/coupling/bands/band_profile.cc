// diptych: tests of the profiles across a band and of Coulomb's, Roscoe's and Arthur's lines
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/bands/band_profile.h"
#include "coupling/bands/theory_lines.h"
#include "tests/coupling/synthetic_samples.h"
#include "tests/common.h"

namespace
{
  using namespace diptych::coupling;

  // 41 strips x 12 blocks. Every number is put in: half width 4 of the band, 2.5 of the relative rotation. The largest couple
  // stress is the largest value of 0.2 sech^2 tanh times 3 sqrt(3)/2. The strips from 15 on have no blocks beyond the fourth.
  ProfileBlocks known_blocks(const double noise, const std::uint64_t seed)
  {
    std::mt19937_64 random(seed);
    ProfileBlocks   blocks;
    for (Eigen::MatrixXd *matrix :
         {&blocks.relative_rotation, &blocks.spin, &blocks.couple_stress, &blocks.solid_fraction, &blocks.squared_fluctuation})
      matrix->setConstant(41, 12, NAN);
    for (int k = 0; k < 41; ++k)
      {
        const double x = k - 20, sech = 1 / std::cosh(x / 4), narrow = 1 / std::cosh(x / 2.5);
        blocks.distance.push_back(x);
        for (int b = 0; b < (x < 15 ? 12 : 4); ++b)
          {
            const auto noisy                 = [&](const double value) { return value + noise * synthetic::normal(random); };
            blocks.relative_rotation(k, b)   = noisy(-0.01 + 0.05 * narrow * narrow);
            blocks.spin(k, b)                = noisy(0.1 * sech * sech);
            blocks.couple_stress(k, b)       = noisy(0.2 * 1.5 * std::sqrt(3.) * sech * sech * std::tanh(x / 4));
            blocks.solid_fraction(k, b)      = noisy(0.85 - 0.04 * sech * sech);
            blocks.squared_fluctuation(k, b) = 0.09;
          }
      }
    return blocks;
  }

  TEST(BandProfile, FitsTheShapesThatWerePutIn)
  {
    const BandProfile p = band_profile(known_blocks(0, 1), 4, {5, 100, 1});
    EXPECT_NEAR(p.spin_amplitude.value, 0.1, 1e-12);
    EXPECT_NEAR(p.couple_stress_peak.value, 0.2, 1e-12);
    EXPECT_NEAR(p.loosening.value, 0.04, 1e-12);
    EXPECT_NEAR(p.rotation_width_10_90.value, 2 * std::atanh(0.8) * 2.5, 0.01);
    EXPECT_NEAR(p.velocity_fluctuation.value[3], 0.3, 1e-14);
    EXPECT_NEAR(p.relative_rotation.value[20], 0.04, 1e-14);
  }

  // 60 samples with noise as large as the amplitude, nominal 95 %. An amplitude of noise alone has no width.
  TEST(BandProfile, IntervalsHoldTheTruth)
  {
    int spin = 0, couple = 0, strip = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed)
      {
        const BandProfile p     = band_profile(known_blocks(0.1, seed), 4, {5, 200, seed});
        const auto        holds = [](const Interval &i, const double truth) { return i.low <= truth && truth <= i.high; };
        spin += holds(p.spin_amplitude, 0.1);
        couple += holds(p.couple_stress_peak, 0.2);
        strip += p.solid_fraction.low[20] <= 0.81 && 0.81 <= p.solid_fraction.high[20];
      }
    for (const int held : {spin, couple, strip})
      {
        EXPECT_GE(held, 52);
        EXPECT_LE(held, 60);
      }
    ProfileBlocks still     = known_blocks(0, 1);
    still.relative_rotation = known_blocks(0.1, 3).couple_stress.cwiseProduct(Eigen::MatrixXd::Constant(41, 12, 1e-3));
    EXPECT_TRUE(std::isnan(band_profile(still, 4, {5, 100, 1}).rotation_width_10_90.value));
  }

  constexpr double degree = M_PI / 180;

  // s1 = 3 s3 is failure at phi = 30 degrees: (s1 - s3)/(s1 + s3) = sin phi. Consider a plane at the angle a to the minor
  // direction, whose normal is at a to the major direction. Mohr's circle gives sigma = s + t cos 2a and tau = t sin 2a.
  // tau/sigma is largest on Coulomb's plane, where it is tan phi.
  TEST(TheoryLines, CoulombPlaneHasTheGreatestObliquity)
  {
    const auto obliquity = [](const double a_deg) {
      const double s1 = 3, s3 = 1, a = a_deg * degree;
      return 0.5 * (s1 - s3) * std::sin(2 * a) / (0.5 * (s1 + s3) + 0.5 * (s1 - s3) * std::cos(2 * a));
    };
    const double coulomb = theory_lines(30, 10).coulomb_deg;
    EXPECT_NEAR(coulomb, 60, 1e-12);
    EXPECT_NEAR(obliquity(coulomb), std::tan(30 * degree), 1e-12);
    EXPECT_GT(obliquity(coulomb), obliquity(coulomb - 1));
    EXPECT_GT(obliquity(coulomb), obliquity(coulomb + 1));
  }

  // Strain increments of the dilatancy angle psi: e1 + e3 = -sin psi (e1 - e3). A line at the angle a to the minor direction
  // stretches by e3 cos^2 a + e1 sin^2 a, which is zero on Roscoe's line.
  TEST(TheoryLines, RoscoeLineDoesNotStretch)
  {
    const double psi = 12, e1 = 1 - std::sin(psi * degree), e3 = -1 - std::sin(psi * degree);
    const double a = theory_lines(30, psi).roscoe_deg * degree;
    EXPECT_NEAR(e3 * std::cos(a) * std::cos(a) + e1 * std::sin(a) * std::sin(a), 0, 1e-12);
  }

  TEST(TheoryLines, RejectsAnglesOutsideTheirRange)
  {
    EXPECT_THROW(theory_lines(90, 0), std::invalid_argument);
    EXPECT_THROW(theory_lines(-1, 0), std::invalid_argument);
    EXPECT_THROW(theory_lines(30, 90), std::invalid_argument);
    EXPECT_THROW(theory_lines(std::numeric_limits<double>::quiet_NaN(), 0), std::invalid_argument);
  }
} // namespace
