// diptych: every point and every piece of a segment belongs to exactly one triangle
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/mesh_cells.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/coupling/synthetic_samples.h"

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

  // Shape functions add up to 1, so their gradients add up to 0; and sum_a x_a (x) grad N_a = 1.
  TEST(MeshCells, ShapeGradientsReproduceAffineFields)
  {
    const QuadMesh mesh = synthetic::box_mesh({0, 0}, {3, 2}, 3, 2, 0.3);
    for (unsigned int t = 0; t < 2 * mesh.cell.size(); ++t)
      {
        const auto      gradient = shape_gradients(mesh, t);
        const auto      node     = triangle_nodes(mesh, t);
        Eigen::Matrix2d identity = Eigen::Matrix2d::Zero();
        for (int k = 0; k < 3; ++k)
          identity += mesh.node[node[k]] * gradient.col(k).transpose();
        EXPECT_LT(gradient.rowwise().sum().norm(), 1e-13);
        EXPECT_LT((identity - Eigen::Matrix2d::Identity()).norm(), 1e-13);
      }
  }

  TEST(MeshCells, CentroidOfEveryTriangleIsFoundInIt)
  {
    const QuadMesh       mesh = synthetic::box_mesh({0, 0}, {30, 20}, 25, 17, 0.24);
    const TriangleSearch search(mesh);
    for (unsigned int t = 0; t < 2 * mesh.cell.size(); ++t)
      {
        const auto &corner = search.corners(t);
        const auto  place  = search.locate((corner[0] + corner[1] + corner[2]) / 3);
        EXPECT_EQ(place.triangle, t);
        EXPECT_TRUE(place.inside);
      }
  }

  // Points on edges and corners, rounded this way or that: the lowest of the triangles that share them.
  TEST(MeshCells, PointOnAnEdgeBelongsToTheLowestTriangle)
  {
    const QuadMesh            mesh = synthetic::box_mesh({0, 0}, {7, 5}, 7, 5, 0.24);
    const TriangleSearch      search(mesh);
    std::vector<unsigned int> lowest_at_node(mesh.node.size(), 1000);
    for (unsigned int t = 2 * mesh.cell.size(); t-- > 0;)
      for (const unsigned int node : triangle_nodes(mesh, t))
        lowest_at_node[node] = t;
    for (unsigned int n = 0; n < mesh.node.size(); ++n)
      EXPECT_EQ(search.locate(mesh.node[n]).triangle, lowest_at_node[n]);

    for (unsigned int c = 0; c < mesh.cell.size(); ++c) // the diagonal is shared by the cell's two triangles
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
    EXPECT_EQ(above.triangle / 2, 10u);
    EXPECT_EQ(search.locate({-3, -4}).triangle / 2, 0u);
  }

  TEST(MeshCells, PiecesOfASegmentFollowOneAnotherWithoutGap)
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

  // Corner 1 pulled across the diagonal 0-2: the other diagonal splits the cell.
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

  TEST(MeshCells, EmptyMeshIsRefused)
  {
    EXPECT_THROW(TriangleSearch{QuadMesh{}}, std::invalid_argument);
  }
} // namespace
