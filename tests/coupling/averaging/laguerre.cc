// diptych: tests of the power cells of discs
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/averaging/power_cells.h"
#include "coupling/averaging/disc_part.h"
#include "tests/coupling/averaging/averaging_cases.h"

namespace
{
  using namespace diptych::coupling;

  struct Discs
  {
    std::vector<Eigen::Vector2d> position;
    std::vector<double>          radius;
  };

  Discs random_discs(const int n, const double largest_radius, const std::uint64_t seed)
  {
    std::mt19937_64 random(seed);
    Discs           discs;
    for (int i = 0; i < n; ++i)
      {
        const double x = synthetic::uniform(random, 0, 20);
        discs.position.emplace_back(x, synthetic::uniform(random, 0, 30));
        discs.radius.push_back(synthetic::uniform(random, 0.1, largest_radius));
      }
    return discs;
  }

  // The radii reach three spacings, so that many discs are hidden and axes lie far from their centres.
  TEST(PowerCells, DivideTheBoxWithoutGapOrOverlap)
  {
    for (const double largest_radius : {0.1, 0.7, 3.})
      {
        const Discs discs = random_discs(600, largest_radius, 1);
        double      sum   = 0;
        for (const PowerCell &cell : power_cells(discs.position, discs.radius, 600, {-1, -1}, {21, 31}))
          sum += polygon_area(cell.corner);
        EXPECT_NEAR(sum, 22 * 32, 1e-9);
      }
  }

  TEST(PowerCells, EveryPointBelongsToTheDiscOfLeastPower)
  {
    const Discs                  discs = random_discs(400, 1.5, 2);
    const std::vector<PowerCell> cells = power_cells(discs.position, discs.radius, 400, {0, 0}, {20, 30});
    std::mt19937_64              random(3);
    const auto                   power = [&](const std::size_t i, const Eigen::Vector2d &x) {
      return (x - discs.position[i]).squaredNorm() - discs.radius[i] * discs.radius[i];
    };
    for (int k = 0; k < 2000; ++k)
      {
        const double          abscissa = synthetic::uniform(random, 0, 20);
        const Eigen::Vector2d x(abscissa, synthetic::uniform(random, 0, 30));
        std::size_t           least = 0;
        for (std::size_t i = 1; i < 400; ++i)
          if (power(i, x) < power(least, x))
            least = i;
        const auto &corner = cells[least].corner;
        ASSERT_GE(corner.size(), 3u);
        for (std::size_t c = 0; c < corner.size(); ++c)
          {
            const Eigen::Vector2d edge = corner[(c + 1) % corner.size()] - corner[c], to = x - corner[c];
            EXPECT_GT(edge.x() * to.y() - edge.y() * to.x(), -1e-9);
          }
      }
  }

  // Both discs at an edge list each other, and both have the same edge.
  TEST(PowerCells, NeighboursShareTheirEdges)
  {
    const Discs                           discs = random_discs(300, 0.7, 4);
    const std::vector<PowerCell>          cells = power_cells(discs.position, discs.radius, 300, {0, 0}, {20, 30});
    std::map<std::pair<int, int>, double> length;
    for (int i = 0; i < 300; ++i)
      for (std::size_t k = 0; k < cells[i].corner.size(); ++k)
        if (cells[i].beyond[k] >= 0)
          length[{i, cells[i].beyond[k]}] = (cells[i].corner[(k + 1) % cells[i].corner.size()] - cells[i].corner[k]).norm();
    EXPECT_GT(length.size(), 1000u);
    for (const auto &[pair, l] : length)
      if (l > 1e-9)
        {
          ASSERT_EQ(length.count({pair.second, pair.first}), 1u);
          EXPECT_NEAR(length.at({pair.second, pair.first}), l, 1e-9);
        }
  }

  // Radii 1 and 3 at a distance of 6: the axis lies (36 + 1 - 9)/12 = 7/3 from the smaller disc. At a distance of 1 it would lie
  // at -3.5, behind the smaller disc. This disc then has no area in a box that ends at -2.
  TEST(PowerCells, AxisHasEqualPowersOfBothDiscs)
  {
    const auto apart = power_cells({{0, 0}, {6, 0}}, {1, 3}, 2, {-2, -2}, {8, 2});
    EXPECT_NEAR(polygon_area(apart[0].corner), 4 * (2 + 7. / 3), 1e-12);
    const auto inside = power_cells({{0, 0}, {1, 0}}, {1, 3}, 2, {-2, -2}, {8, 2});
    EXPECT_TRUE(inside[0].corner.empty());
    EXPECT_NEAR(polygon_area(inside[1].corner), 40, 1e-12);
    const auto equal = power_cells({{0, 0}, {0, 0}}, {1, 1}, 2, {-2, -2}, {8, 2});
    EXPECT_NEAR(polygon_area(equal[0].corner), 40, 1e-12);
    EXPECT_TRUE(equal[1].corner.empty());
    EXPECT_THROW((void)power_cells({{0, 0}}, {1, 1}, 1, {-2, -2}, {8, 2}), std::invalid_argument);
  }

  // A power cell that covers two cells of the mesh by 3 to 1 must distribute its grain's mass by 3 to 1. Two grains at x = 1 and
  // 7 lie in a box of width 8 with cells of width 3 and 1, so the axis is at x = 4.
  TEST(Laguerre, SharesFollowThePowerCell)
  {
    QuadMesh mesh;
    mesh.node = {{0, 0}, {3, 0}, {5, 0}, {8, 0}, {0, 2}, {3, 2}, {5, 2}, {8, 2}};
    mesh.cell = {{{0, 1, 5, 4}}, {{1, 2, 6, 5}}, {{2, 3, 7, 6}}};
    triangulate(mesh);
    Carriers c;
    c.position     = {{1, 1}, {7, 1}};
    c.radius       = {0.5, 0.5};
    c.of_grains    = Columns::Identity(2, 2);
    const auto out = distribute({AveragingMethod::laguerre, KernelShape::gauss, 1}, TargetCells(mesh), c).of_grains;
    EXPECT_NEAR(out(0, 0), 0.75, 1e-13);
    EXPECT_NEAR(out(1, 0), 0.25, 1e-13);
    EXPECT_NEAR(out(1, 1), 0.25, 1e-13);
    EXPECT_NEAR(out(2, 1), 0.75, 1e-13);
  }

  // A half disc of radius 1 has the area pi/2 and the first moment 2/3 away from its diameter; a quarter has pi/4 and (1/3, 1/3).
  TEST(DiscPart, AreaAndMomentOfHalfAndQuarter)
  {
    const std::vector<Eigen::Vector2d> square = {{0, 0}, {3, 0}, {3, 3}, {0, 3}};
    const DiscPart                     half = disc_part({0, 1.5}, 1, square), quarter = disc_part({3, 3}, 1, square);
    EXPECT_NEAR(half.area, M_PI / 2, 1e-14);
    EXPECT_NEAR((half.moment - Eigen::Vector2d(2. / 3, 0)).norm(), 0, 1e-14);
    EXPECT_NEAR(quarter.area, M_PI / 4, 1e-14);
    EXPECT_NEAR((quarter.moment - Eigen::Vector2d(-1. / 3, -1. / 3)).norm(), 0, 1e-14);
    EXPECT_NEAR(disc_part({1.5, 1.5}, 1, square).area, M_PI, 1e-14);
    EXPECT_NEAR(disc_part({1.5, 1.5}, 5, square).area, 9, 1e-13);
  }
} // namespace
