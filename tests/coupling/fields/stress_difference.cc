// diptych: tests of the difference of the panels' stresses and of the sampling scatter
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/fields/stress_difference.h"

#include <cmath>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace
{
  using namespace diptych::coupling;

  StressPair constant_pair(const QuadMesh &mesh, const Eigen::Matrix2d &grains, const Eigen::Matrix2d &continuum)
  {
    return {std::vector<Eigen::Matrix2d>(mesh.cell.size(), grains), std::vector<Eigen::Matrix2d>(mesh.cell.size(), continuum),
            std::vector<double>(mesh.cell.size(), 0.1)};
  }

  // diag(1, 2) and diag(1, 3): |difference| = 1, |continuum| = sqrt(10). Both are uniform, so there is no scatter, and have equal
  // axes.
  TEST(StressDifference, IsTheNormOfTheDifferenceRelativeToTheContinuum)
  {
    const QuadMesh         mesh = regular_grid({0, 0}, {4, 4}, 1);
    const StressDifference d    = stress_difference(
         mesh, constant_pair(mesh, Eigen::Vector2d(1, 2).asDiagonal(), Eigen::Vector2d(1, 3).asDiagonal()));
    EXPECT_EQ(d.cells, 16);
    EXPECT_NEAR(d.size, 1, 1e-14);
    EXPECT_NEAR(d.relative_l2, 1 / std::sqrt(10.), 1e-14);
    EXPECT_NEAR(d.direction_deg, 0, 1e-6);
    EXPECT_NEAR(d.sampling_alone, 0, 1e-12);
    EXPECT_NEAR(d.lowest_scatter, 0.1 / std::sqrt(10.), 1e-14);
  }

  // Only the symmetric parts count. Rotating a stress by 30 degrees rotates its axes by 30; rotating it by 180 - 30 gives 30,
  // too.
  TEST(StressDifference, DirectionIsTheAngleBetweenAxes)
  {
    const QuadMesh        mesh  = regular_grid({0, 0}, {3, 3}, 1);
    const Eigen::Matrix2d axial = Eigen::Vector2d(3, 1).asDiagonal();
    for (const double turn : {30., -30., 150.})
      {
        const Eigen::Matrix2d r      = Eigen::Rotation2Dd(turn * M_PI / 180).toRotationMatrix();
        Eigen::Matrix2d       turned = r * axial * r.transpose();
        turned(0, 1) += 0.2, turned(1, 0) -= 0.2;
        EXPECT_NEAR(stress_difference(mesh, constant_pair(mesh, turned, axial)).direction_deg, 30, 1e-10);
      }
  }

  // Independent noise of variance v on xx, yy and xy has E |noise|^2 = 4 v in the Frobenius norm (xy counts twice). Relative to
  // |continuum| = sqrt(2) the scatter is sqrt(4 v). A quadratic field under the noise does not change it. With 900 cells the
  // variance from 2700 numbers is accurate to sqrt(2/2700) = 2.7 % and its root to 1.4 %; five times that is allowed.
  TEST(StressDifference, ScatterOfNoiseOnAQuadraticFieldIsTheNoise)
  {
    const QuadMesh  mesh = regular_grid({0, 0}, {30, 30}, 1);
    StressPair      pair = constant_pair(mesh, Eigen::Matrix2d::Identity(), Eigen::Matrix2d::Identity());
    std::mt19937_64 random(5);
    const double    v     = 0.01;
    const auto      noise = [&] { return std::sqrt(12 * v) * (double(random() >> 11) / 9007199254740992. - 0.5); };
    for (unsigned int k = 0; k < mesh.cell.size(); ++k)
      {
        const Eigen::Vector2d x  = cell_centre(mesh, k) / 30;
        const double          xy = noise() + 0.5 * x.x() * x.y();
        pair.grains[k] << 1 + x.x() * x.x() + noise(), xy, xy, 1 - x.y() + noise();
      }
    EXPECT_NEAR(stress_difference(mesh, pair).sampling_alone, std::sqrt(4 * v / 2), 0.07 * std::sqrt(2 * v));
  }

  TEST(StressDifference, IgnoresCellsWithoutAValueInEitherPanel)
  {
    const QuadMesh mesh = regular_grid({0, 0}, {4, 4}, 1);
    StressPair     pair = constant_pair(mesh, 2 * Eigen::Matrix2d::Identity(), Eigen::Matrix2d::Identity());
    pair.grains[3].setConstant(NAN);
    pair.continuum[7].setConstant(NAN);
    const StressDifference d = stress_difference(mesh, pair);
    EXPECT_EQ(d.cells, 14);
    EXPECT_NEAR(d.relative_l2, 1, 1e-14);
  }

  TEST(StressDifference, TooFewCellsGiveNoScatterAndNoVerdict)
  {
    const QuadMesh   mesh = regular_grid({0, 0}, {2, 3}, 1); // six cells, as many as the polynomial has coefficients
    StressDifference d = stress_difference(mesh, constant_pair(mesh, Eigen::Matrix2d::Identity(), Eigen::Matrix2d::Identity()));
    d.label            = "6 d";
    EXPECT_TRUE(std::isnan(d.sampling_alone));
    EXPECT_NE(stress_verdict(d).find("too few cells of 6 d"), std::string::npos);
  }

  // 0.5 and 0.3: the part beyond sampling is sqrt(0.25 - 0.09) = 0.4.
  TEST(StressDifference, VerdictSubtractsTheSquareOfTheSamplingScatter)
  {
    StressDifference d;
    d.label = "6 d", d.relative_l2 = 0.5, d.sampling_alone = 0.3;
    EXPECT_NE(stress_verdict(d).find("beyond sampling by 40 %"), std::string::npos);
    d.relative_l2 = 0.29;
    EXPECT_NE(stress_verdict(d).find("no difference beyond sampling"), std::string::npos);
  }
} // namespace
