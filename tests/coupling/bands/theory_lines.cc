// diptych: tests of Coulomb's, Roscoe's and Arthur's lines, with Mohr circles
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/bands/theory_lines.h"

#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

namespace
{
  using namespace diptych::coupling;

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

  TEST(TheoryLines, ArthurLiesInTheMiddle)
  {
    const TheoryLines lines = theory_lines(36, 8);
    EXPECT_NEAR(lines.arthur_deg, 0.5 * (lines.coulomb_deg + lines.roscoe_deg), 1e-12);
  }

  // Under vertical compression the minor direction is horizontal and the bands are at +-60. Rotated by 40 degrees they are at
  // 100, which is -80, and at -20.
  TEST(TheoryLines, ConjugateBandsLieToEitherSideOfTheMinorDirection)
  {
    const auto upright = conjugate_angles_deg(60, 0), turned = conjugate_angles_deg(60, 40), level = conjugate_angles_deg(90, 0);
    EXPECT_NEAR(upright[0], 60, 1e-12);
    EXPECT_NEAR(upright[1], -60, 1e-12);
    EXPECT_NEAR(turned[0], -80, 1e-12);
    EXPECT_NEAR(turned[1], -20, 1e-12);
    EXPECT_NEAR(level[0], 90, 1e-12); // range (-90, 90]
    EXPECT_NEAR(level[1], 90, 1e-12);
  }

  TEST(TheoryLines, RejectsAnglesOutsideTheirRange)
  {
    EXPECT_THROW(theory_lines(90, 0), std::invalid_argument);
    EXPECT_THROW(theory_lines(-1, 0), std::invalid_argument);
    EXPECT_THROW(theory_lines(30, 90), std::invalid_argument);
    EXPECT_THROW(theory_lines(std::numeric_limits<double>::quiet_NaN(), 0), std::invalid_argument);
  }
} // namespace
