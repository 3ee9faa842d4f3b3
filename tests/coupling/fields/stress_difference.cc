// diptych: tests of the difference of the panels' stresses, its scatter and the averaging length
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/fields/stress_difference.h"
#include "coupling/fields/resolution_study.h"
#include "coupling/averaging/point_stress.h"
#include "benchmarks/homogenisation/airy_network.h"
#include "tests/common.h"

#include <Eigen/Geometry>
#include "tests/coupling/averaging/averaging_cases.h"
#include "tests/coupling/averaging/hexagonal_lattice.h"

namespace
{
  using namespace diptych;
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

  ResolutionRow row(const double width, const std::vector<std::pair<double, double>> &values)
  {
    ResolutionRow result;
    result.width = width;
    for (const auto &[s, t_over_s] : values)
      result.points.push_back({"", s, t_over_s});
    return result;
  }

  // Point 1 is steady from 0.5 to 4, point 2 only from 1 to 3. 5 % of the mean of 1, 1.06, 1.06 (1.04) allow 0.988 .. 1.092, but
  // neither the 0.9 at 0.5 nor the t/s of 0.6 at 4.
  TEST(ResolutionStudy, PlateauIsTheWidestRangeWithAllPointsSteady)
  {
    const std::vector<ResolutionRow> rows    = {row(0.5, {{1, 0.3}, {0.9, 0.5}}), row(1, {{1, 0.3}, {1, 0.5}}),
                                                row(2, {{1, 0.3}, {1.06, 0.5}}), row(3, {{1, 0.3}, {1.06, 0.5}}),
                                                row(4, {{1, 0.3}, {1.06, 0.6}})};
    const auto                       plateau = find_plateau(rows);
    ASSERT_TRUE(plateau);
    EXPECT_EQ((*plateau)[0], 1);
    EXPECT_EQ((*plateau)[1], 3);
  }

  // The first case is steady only between 2 and 3, less than a factor of two. A point without a value has no plateau. Without
  // points there is no verdict.
  TEST(ResolutionStudy, WithoutASteadyRangeThereIsNoPlateau)
  {
    EXPECT_FALSE(find_plateau({row(1, {{1, 0.3}}), row(2, {{2, 0.3}}), row(3, {{2, 0.3}}), row(4, {{4, 0.3}})}));
    EXPECT_FALSE(find_plateau({row(1, {{1, NAN}}), row(2, {{1, NAN}})}));
    EXPECT_FALSE(find_plateau({row(1, {}), row(2, {})}));
  }

  // A hexagonal lattice of diameter 1 under sqrt(3) in all directions, with periodic sides. At w = 0.5 the kernel shows a ripple
  // of the lattice of relative size 6 exp(-8 pi^2 w^2 / 3) = 0.8 %, and nothing for larger widths. All widths form a plateau,
  // with t = 0. The kernel's reach at the largest width, 16, does not touch the ends.
  TEST(ResolutionStudy, UniformLatticeIsAPlateau)
  {
    const double       row_height = std::sqrt(3.) / 2;
    const int          columns = 12, rows = 44;
    const GrainNetwork network = synthetic::periodic_lattice(columns, rows);
    discrete::Snapshot s;
    s.position = network.position, s.radius = network.radius, s.window_forces = network.forces, s.cell_width = columns;
    const Eigen::Vector2d lower(0, -0.5 * row_height), size(columns, rows * row_height);
    const QuadMesh        mesh   = synthetic::box_mesh(lower, lower + size, 6, 22);
    const double          middle = 0.5 * (rows - 1) * row_height;
    const ResolutionStudy study  = resolution_study(mesh, s, {{"middle", {5, middle}}, {"side", {12, middle + 0.3}}});
    for (const ResolutionRow &r : study.kernel)
      for (const PointStress &p : r.points)
        {
          EXPECT_NEAR(p.s / std::sqrt(3.), 1, r.width == 0.5 ? 0.01 : 1e-3)
            << r.width << p.name; // 1e-3: quadrature error on the mesh
          EXPECT_LT(p.t_over_s, r.width == 0.5 ? 0.01 : 1e-3);
        }
    ASSERT_TRUE(study.plateau);
    EXPECT_EQ((*study.plateau)[0], 0.5);
    EXPECT_EQ((*study.plateau)[1], 4);
    ASSERT_EQ(study.kernel.size(), kernel_widths.size());
    ASSERT_EQ(study.cells.size(), cell_sizes.size());
    EXPECT_EQ(study.kernel[0].points[1].name, "side");
  }

  // A pressure wave of amplitude 0.3 and length 20 in a disordered network. A Gauss kernel of deviation w takes exp(-k^2 w^2) off
  // it (half of the exponent for x, half for y), whatever the disorder of the grains adds. The amplitude is fitted to points 2
  // apart over L x L = 58 x 58. Of the rest, of root mean square e, an area of 4 pi w^2 counts as one independent value. The
  // amplitude is therefore within 3 e / sqrt(L^2/(4 pi w^2)) / sqrt(1/4), where 1/4 is the wave's mean square. A branch of length
  // 1 spreads its force, with a variance of 1/12: less than k^2/12 = 0.8 % of the amplitude.
  TEST(ResolutionStudy, KernelDampsAWaveByTheGaussFactor)
  {
    const double                 length = 20, k = 2 * M_PI / length;
    const auto                   network = benchmarks::airy_network({0, 0}, {80, 80}, benchmarks::pressure_wave(0.3, length), 1);
    const Carriers               moments = moment_carriers(network.position, network.radius, network.contacts);
    const TargetCells            region(regular_grid({0, 0}, {80, 80}, 2));
    std::vector<Eigen::Vector2d> points;
    for (double x = 11; x < 70; x += 2)
      for (double y = 11; y < 70; y += 2)
        points.emplace_back(x, y);
    const auto wave = [k](const Eigen::Vector2d &x) { return std::cos(k * x.x()) * std::cos(k * x.y()); };
    for (const double w : {1., 2.})
      {
        const auto stress  = stress_at_points(region, moments, points, KernelShape::gauss, w);
        double     squares = 0, product = 0, rest = 0;
        for (std::size_t p = 0; p < points.size(); ++p)
          squares += std::pow(wave(points[p]), 2), product += wave(points[p]) * (0.5 * stress[p].trace() - 1);
        const double amplitude = product / squares;
        for (std::size_t p = 0; p < points.size(); ++p)
          rest += std::pow(0.5 * stress[p].trace() - 1 - amplitude * wave(points[p]), 2) / double(points.size());
        const double error = std::sqrt(rest) * std::sqrt(4 * M_PI) * w / 58 / 0.5;
        EXPECT_LT(error, 0.01); // ensures that the next line can fail
        const double exact = 0.3 * std::exp(-k * k * w * w);
        EXPECT_NEAR(amplitude, exact, 3 * error + exact * k * k / 12) << w;
      }
  }
} // namespace
