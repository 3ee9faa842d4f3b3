// diptych: tests of the areas shared by the cells of two meshes
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/cells/cell_overlap.h"

#include <numeric>
#include <stdexcept>

#include <gtest/gtest.h>

namespace
{
  using namespace diptych::coupling;

  // Grids of 2 x 2 and 3 x 3 cells on a square of side 6, with cells 3 and 2 wide. The lower left coarse cell [0,3]^2 shares
  // areas of 2 x 2, 1 x 2, 2 x 1 and 1 x 1 with the fine cells 0, 1, 3 and 4.
  TEST(CellOverlap, SharedAreasOfTwoGridsEqualThoseOfTheirRectangles)
  {
    const QuadMesh    coarse = regular_grid({0, 0}, {6, 6}, 3), fine = regular_grid({0, 0}, {6, 6}, 2);
    const CellOverlap overlap = cell_overlap(coarse, fine);
    ASSERT_EQ(overlap.begin.size(), 5u);
    ASSERT_EQ(overlap.begin[1], 4u);
    const std::vector<unsigned int> cells(overlap.cell.begin(), overlap.cell.begin() + 4);
    EXPECT_EQ(cells, (std::vector<unsigned int>{0, 1, 3, 4}));
    const double expected[] = {4, 2, 2, 1};
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_NEAR(overlap.area[k], expected[k], 1e-13);
    EXPECT_NEAR(std::accumulate(overlap.area.begin(), overlap.area.end(), 0.), 36, 1e-12);
  }

  // 1e9 x 1e9 cells of side 1.
  TEST(CellOverlap, RejectsAGridOfMoreCellsThanMemoryHolds)
  {
    EXPECT_THROW((void)regular_grid({0, 0}, {1e9, 1e9}, 1), std::invalid_argument);
  }

  // The diamond's corners are the middles of the sides of a square of side 2, so it has half the square's area. Each of the four
  // unit cells holds a quarter of the diamond.
  TEST(CellOverlap, RotatedCellSharesAQuarterOfItsAreaWithEachQuadrant)
  {
    QuadMesh diamond;
    diamond.node = {{1, 0}, {2, 1}, {1, 2}, {0, 1}};
    diamond.cell = {{{0, 1, 2, 3}}};
    triangulate(diamond);
    const CellOverlap overlap = cell_overlap(diamond, regular_grid({0, 0}, {2, 2}, 1));
    ASSERT_EQ(overlap.cell.size(), 4u);
    for (const double area : overlap.area)
      EXPECT_NEAR(area, 0.5, 1e-14);
  }

  TEST(CellOverlap, MeansAreWeightedBySharedAreaAndMissingIfHalfTheCellHasNoValue)
  {
    const CellOverlap   overlap = cell_overlap(regular_grid({0, 0}, {6, 6}, 3), regular_grid({0, 0}, {6, 6}, 2));
    std::vector<double> values  = {1, 2, 3, 4, 5, 6, 7, 8, 9};
    // (4 * 1 + 2 * 2 + 2 * 4 + 1 * 5) / 9
    EXPECT_NEAR(carried_over<double>(overlap, values, NAN)[0], 21. / 9, 1e-14);
    values[0] = NAN; // 5 of 9 remain
    EXPECT_NEAR(carried_over<double>(overlap, values, NAN)[0], 17. / 5, 1e-14);
    values[1] = NAN; // 3 of 9 remain
    EXPECT_TRUE(std::isnan(carried_over<double>(overlap, values, NAN)[0]));
  }

  TEST(CellOverlap, TransfersTensorsComponentByComponent)
  {
    const CellOverlap            overlap = cell_overlap(regular_grid({0, 0}, {4, 2}, 2), regular_grid({0, 0}, {4, 2}, 1));
    std::vector<Eigen::Matrix2d> values(8);
    for (int k = 0; k < 8; ++k)
      values[k] << k, 1, 2, -k;
    const auto      means = carried_over<Eigen::Matrix2d>(overlap, values, Eigen::Matrix2d::Constant(NAN));
    Eigen::Matrix2d expected;
    expected << 2.5, 1, 2, -2.5; // cells 0, 1, 4, 5
    EXPECT_LT((means[0] - expected).norm(), 1e-14);
  }
} // namespace
