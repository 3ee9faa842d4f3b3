// diptych: tests that every point belongs to one triangle, and of the areas shared by the cells of two meshes
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/cells/mesh_cells.h"
#include "coupling/cells/triangle_search.h"
#include "coupling/cells/cell_overlap.h"
#include "tests/coupling/synthetic_samples.h"
#include "tests/common.h"

namespace
{
  using namespace diptych::coupling;

  TEST(MeshCells, AreasOfADistortedMeshAddUpToItsBox)
  {
    double sum = 0;
    for (const double area : cell_areas(synthetic::box_mesh({-1, 2}, {11, 20}, 6, 9, 0.3)))
      sum += area;
    EXPECT_NEAR(sum, 12 * 18, 1e-11);
  }

  // Shape functions add up to 1, so their gradients add up to 0. Moreover sum_a x_a (x) grad N_a = 1.
  TEST(MeshCells, ShapeGradientsReproduceAffineFields)
  {
    const QuadMesh mesh = synthetic::box_mesh({0, 0}, {3, 2}, 3, 2, 0.3);
    for (unsigned int t = 0; t < mesh.triangle.size(); ++t)
      {
        const auto      gradient = shape_gradients(mesh, t);
        const auto      node     = triangle_nodes(mesh, t);
        Eigen::Matrix2d identity = Eigen::Matrix2d::Zero();
        for (int k = 0; k < 3; ++k)
          identity += mesh.node[node[k]] * gradient.col(k).transpose();
        EXPECT_LT(gradient.rowwise().sum().norm(), 1e-13);
        EXPECT_LT((identity - Eigen::Matrix2d::Identity()).norm(), 1e-13);
        for (int k = 0; k < 3; ++k)
          EXPECT_LT((shape_values(mesh, t, mesh.node[node[k]]) - Eigen::Vector3d::Unit(k)).norm(), 1e-13);
      }
  }

  TEST(MeshCells, LocatesTheCentroidOfEveryTriangleInIt)
  {
    const QuadMesh       mesh = synthetic::box_mesh({0, 0}, {30, 20}, 25, 17, 0.24);
    const TriangleSearch search(mesh);
    for (unsigned int t = 0; t < mesh.triangle.size(); ++t)
      {
        const auto &corner = search.corners(t);
        const auto  place  = search.locate((corner[0] + corner[1] + corner[2]) / 3);
        EXPECT_EQ(place.triangle, t);
        EXPECT_TRUE(place.inside);
      }
  }

  // Points on edges and corners, with rounding errors of either sign, belong to the lowest of the triangles that share them.
  TEST(MeshCells, PointOnAnEdgeBelongsToTheLowestTriangle)
  {
    const QuadMesh            mesh = synthetic::box_mesh({0, 0}, {7, 5}, 7, 5, 0.24);
    const TriangleSearch      search(mesh);
    std::vector<unsigned int> lowest_at_node(mesh.node.size(), 1000);
    for (unsigned int t = mesh.triangle.size(); t-- > 0;)
      for (const unsigned int node : triangle_nodes(mesh, t))
        lowest_at_node[node] = t;
    for (unsigned int n = 0; n < mesh.node.size(); ++n)
      EXPECT_EQ(search.locate(mesh.node[n]).triangle, lowest_at_node[n]);

    for (unsigned int c = 0; c < mesh.cell.size(); ++c) // the two triangles of the cell share the diagonal
      for (int k = 1; k < 10; ++k)
        {
          const Eigen::Vector2d &a = mesh.node[mesh.cell[c][0]], &b = mesh.node[mesh.cell[c][2]];
          EXPECT_EQ(search.locate(a + k / 10. * (b - a)).triangle, 2 * c);
        }
  }

  TEST(MeshCells, PointOutsideGoesToTheNearestBoundaryCell)
  {
    const QuadMesh       mesh = synthetic::box_mesh({0, 0}, {4, 3}, 4, 3);
    const TriangleSearch search(mesh);
    const auto           above = search.locate({2.5, 100});
    EXPECT_FALSE(above.inside);
    EXPECT_EQ(mesh.triangle[above.triangle].cell, 10u);
    EXPECT_EQ(mesh.triangle[search.locate({-3, -4}).triangle].cell, 0u);
  }

  TEST(MeshCells, PiecesOfASegmentLeaveNoGap)
  {
    const QuadMesh                     mesh = synthetic::box_mesh({0, 0}, {10, 10}, 9, 9, 0.3);
    const TriangleSearch               search(mesh);
    std::mt19937_64                    random(3);
    std::vector<TriangleSearch::Piece> pieces;
    for (int k = 0; k < 2000; ++k)
      {
        const Eigen::Vector2d a(synthetic::uniform(random, -1, 11), synthetic::uniform(random, -1, 11));
        const Eigen::Vector2d b = k % 7 == 0 ? a : Eigen::Vector2d(synthetic::uniform(random, -1, 11), a.y());
        search.cut(a, b, pieces);
        ASSERT_FALSE(pieces.empty());
        EXPECT_EQ(pieces.front().from, 0);
        EXPECT_EQ(pieces.back().to, 1);
        for (std::size_t p = 1; p < pieces.size(); ++p)
          EXPECT_EQ(pieces[p].from, pieces[p - 1].to);
      }
  }

  // Corner 1 is pulled across the diagonal 0-2, so the other diagonal splits the cell.
  TEST(MeshCells, ConcaveCellIsSplitAlongItsInnerDiagonal)
  {
    diptych::continuum::Snapshot snapshot;
    snapshot.position   = {{0, 0}, {0.4, 0.6}, {1, 1}, {0, 1}};
    snapshot.cells      = {{{0, 1, 2, 3, 0, 0, 0, 0, 0}}};
    const QuadMesh mesh = quad_mesh(snapshot);
    EXPECT_GT(triangle_area(mesh, 0), 0);
    EXPECT_GT(triangle_area(mesh, 1), 0);
    // shoelace: 0.5 ((0) + (0.4 - 0.6) + 1 + 0) = 0.4
    EXPECT_NEAR(cell_areas(mesh)[0], 0.4, 1e-15);

    std::swap(snapshot.position[1], snapshot.position[3]); // clockwise
    EXPECT_THROW(quad_mesh(snapshot), std::runtime_error);
  }

  // Nodes are moved by up to 0.3 except on the outline; the hanging ones leave their chords. Every edge of one triangle only must
  // still lie on the outline, 2 (20 + 30) long, and the polygons must fill the box.
  TEST(MeshCells, CellsMeetWithoutGapAtDisplacedHangingNodes)
  {
    const auto diagonal = [](const Eigen::Vector2d &x) { return std::abs(x.x() - 0.7 * x.y()) < 3; };
    const auto bump     = [](const Eigen::Vector2d &x) {
      const double size = 0.3 * std::sin(M_PI * x.x() / 20) * std::sin(M_PI * x.y() / 30);
      return Eigen::Vector2d(size * std::sin(2.1 * x.y()), size * std::cos(1.7 * x.x()));
    };
    const QuadMesh mesh = synthetic::refined_mesh({0, 0}, {20, 30}, {{10, 15}}, diagonal, bump);
    ASSERT_GT(mesh.triangle.size(), 2 * mesh.cell.size()) << "there are hanging nodes";

    std::map<std::pair<unsigned int, unsigned int>, int> count;
    double                                               area = 0, outline = 0;
    for (unsigned int t = 0; t < mesh.triangle.size(); ++t)
      {
        EXPECT_GT(triangle_area(mesh, t), 0);
        for (int k = 0; k < 3; ++k)
          ++count[std::minmax(mesh.triangle[t].node[k], mesh.triangle[t].node[(k + 1) % 3])];
      }
    for (const auto &[edge, triangles] : count)
      if (triangles == 1)
        outline += (mesh.node[edge.second] - mesh.node[edge.first]).norm();
    for (const double a : cell_areas(mesh))
      area += a;
    EXPECT_NEAR(outline, 100, 1e-11);
    EXPECT_NEAR(area, 600, 1e-10);
  }

  // The cell [0, 1] x [0, 1] lies beside two smaller cells and has a hanging node at (1, 0.5). The displacement 0.1 moves this
  // node to (1.1, 0.5). The cell gains a triangle of area 0.5 x 1 x 0.1, and each neighbour loses half of it. Corner 0 comes
  // first.
  TEST(MeshCells, CoarseCellFollowsItsHangingNodeWhereverItMoves)
  {
    diptych::continuum::Snapshot snapshot;
    snapshot.position = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {1.1, 0.5}, {1.5, 0}, {1.5, 0.5}, {1.5, 1}};
    snapshot.displacement.assign(8, Eigen::Vector2d::Zero());
    snapshot.displacement[4] = {0.1, 0};
    snapshot.cells           = {{{0, 1, 2, 3, 0, 0, 0, 0, 0}}, {{1, 5, 6, 4, 0, 0, 0, 0, 0}}, {{4, 6, 7, 2, 0, 0, 0, 0, 0}}};
    const QuadMesh mesh      = quad_mesh(snapshot);
    const auto     areas     = cell_areas(mesh);
    EXPECT_NEAR(areas[0], 1.05, 1e-15);
    EXPECT_NEAR(areas[1], 0.225, 1e-15);
    EXPECT_NEAR(areas[2], 0.225, 1e-15);
    const auto outlines = cell_outlines(mesh);
    ASSERT_EQ(outlines[0].size(), 5u);
    EXPECT_EQ(mesh.node[outlines[0][0]], snapshot.position[0]);
    EXPECT_EQ(mesh.node[outlines[0][2]], snapshot.position[4]);
    EXPECT_EQ(outlines[1].size(), 4u);

    // The node moves beyond the far side and the polygon intersects itself.
    snapshot.position[4]     = {-0.5, 0.5};
    snapshot.displacement[4] = {-1.5, 0};
    EXPECT_THROW(quad_mesh(snapshot), std::runtime_error);
  }

  // The middle one of nine cells is a square with a node in the middle of every edge, because the other eight are cut into four.
  // Its best division has four triangles at the corners and two in the inner square, all of them halves of squares.
  TEST(MeshCells, CellWithFourHangingNodesIsDividedIntoHalvesOfSquares)
  {
    const auto     outer = [](const Eigen::Vector2d &x) { return (x - Eigen::Vector2d(3, 3)).norm() > 0.5; };
    const auto     still = [](const Eigen::Vector2d &) { return Eigen::Vector2d(0, 0); };
    const QuadMesh mesh  = synthetic::refined_mesh({0, 0}, {6, 6}, {{3, 3}}, outer, still);
    const auto     areas = cell_areas(mesh);
    unsigned int   n     = 0;
    for (unsigned int t = 0; t < mesh.triangle.size(); ++t)
      if (areas[mesh.triangle[t].cell] > 2) // 2 x 2; the other cells are 1 x 1
        {
          double longest = 0;
          for (int k = 0; k < 3; ++k)
            longest = std::max(
              longest, (mesh.node[mesh.triangle[t].node[k]] - mesh.node[mesh.triangle[t].node[(k + 1) % 3]]).squaredNorm());
          EXPECT_NEAR(triangle_area(mesh, t) / longest, 0.25, 1e-15); // legs a: a^2 / 2 over 2 a^2
          ++n;
        }
    EXPECT_EQ(n, 6u);
  }

  // 10 x 7 in cells of about 3: three columns 3.33 wide and two rows 3.5 high.
  TEST(MeshCells, RegularGridFillsItsBoxWithEqualCells)
  {
    const QuadMesh mesh = regular_grid({-1, 2}, {9, 9}, 3);
    ASSERT_EQ(mesh.cell.size(), 6u);
    for (const double area : cell_areas(mesh))
      EXPECT_NEAR(area, 70. / 6, 1e-13);
    EXPECT_EQ(mesh.node.front(), Eigen::Vector2d(-1, 2));
    EXPECT_EQ(mesh.node.back(), Eigen::Vector2d(9, 9));
    EXPECT_LT((cell_centre(mesh, 5) - Eigen::Vector2d(9 - 10. / 6, 9 - 7. / 4)).norm(), 1e-14);
    EXPECT_THROW(regular_grid({0, 0}, {0, 1}, 1), std::invalid_argument);
    EXPECT_THROW(regular_grid({0, 0}, {1, 1}, 0), std::invalid_argument);
    EXPECT_THROW((void)regular_grid({0, 0}, {1e9, 1e9}, 1), std::invalid_argument) << "more cells than memory holds";
    EXPECT_EQ(regular_grid({0, 0}, {1, 1}, 100).cell.size(), 1u);
  }

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
