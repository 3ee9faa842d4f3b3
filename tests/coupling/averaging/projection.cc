// diptych: tests of the smoothing by the projection onto linear elements
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>

#include "tests/coupling/averaging/averaging_cases.h"

namespace
{
  using namespace diptych::coupling;

  Columns projected(const QuadMesh &mesh, const std::vector<Eigen::Vector2d> &points, const double width, const double period = 0)
  {
    Carriers c;
    c.position  = points;
    c.radius    = std::vector<double>(points.size(), 0.5);
    c.of_grains = Columns::Identity(Eigen::Index(points.size()), Eigen::Index(points.size()));
    return distribute({AveragingMethod::projection, KernelShape::gauss, width}, TargetCells(mesh, period), c).of_grains;
  }

  // c - l^2 laplacian c = delta with l = w / sqrt 2 has the solution c = K_0(r/l) / (2 pi l^2), of integral 1 and standard
  // deviation w along each axis. Sums over cells of 0.4 = w/5 are used with the moments of their centres. These are second order
  // in h/w with small constants, 1 %. The part beyond 10 = 7 l is 7 exp(-7) = 0.6 %.
  TEST(Projection, WidthIsTheStandardDeviation)
  {
    const QuadMesh  mesh = synthetic::box_mesh({-10, -10}, {10, 10}, 51, 51);
    const Columns   sums = projected(mesh, {{0.07, -0.05}}, 2);
    Eigen::Vector2d mean = Eigen::Vector2d::Zero(), square = mean;
    for (unsigned int k = 0; k < mesh.cell.size(); ++k)
      mean += sums(k, 0) * cell_centre(mesh, k), square += sums(k, 0) * cell_centre(mesh, k).cwiseAbs2();
    EXPECT_NEAR(sums.sum(), 1, 1e-12);
    EXPECT_NEAR(mean.norm(), std::hypot(0.07, 0.05), 0.01);
    EXPECT_NEAR(std::sqrt(square.x() - mean.x() * mean.x()), 2, 0.02);
    EXPECT_NEAR(std::sqrt(square.y() - mean.y() * mean.y()), 2, 0.02);
  }

  // Sums over cells for a load of this density. Its carriers are in the middles of the triangles' edges, each with a third of the
  // triangle's area. This rule is exact for quadratic functions.
  template <class Density> Eigen::VectorXd projected_load(const QuadMesh &mesh, const double width, const Density &density)
  {
    std::vector<Eigen::Vector2d> points;
    std::vector<double>          load;
    for (unsigned int t = 0; t < mesh.triangle.size(); ++t)
      for (unsigned int k = 0; k < 3; ++k)
        {
          points.push_back(0.5 * (mesh.node[mesh.triangle[t].node[k]] + mesh.node[mesh.triangle[t].node[(k + 1) % 3]]));
          load.push_back(triangle_area(mesh, t) / 3 * density(points.back()));
        }
    return projected(mesh, points, width) * Eigen::Map<const Eigen::VectorXd>(load.data(), Eigen::Index(load.size()));
  }

  // No flux leaves the mesh, so an even load gives an even density up to the sides.
  TEST(Projection, EvenLoadGivesAnEvenDensityUpToTheEdge)
  {
    const Eigen::VectorXd sums = projected_load(synthetic::box_mesh({0, 0}, {8, 8}, 8, 8), 1.3, [](const auto &) { return 1.; });
    for (const double sum : sums)
      EXPECT_NEAR(sum, 1, 1e-12);
  }

  // Hanging nodes are nodes of the smaller and of the larger cells. Without smoothing (w -> 0) a linear density is reproduced
  // across them, because it is one of the functions.
  TEST(Projection, LinearDensityIsReproducedAcrossHangingNodes)
  {
    const auto            inner = [](const Eigen::Vector2d &x) { return x.x() > 3 && x.y() > 2 && x.y() < 6; };
    const QuadMesh        mesh  = synthetic::refined(synthetic::box_mesh({0, 0}, {8, 8}, 8, 8, 0.2), inner).mesh;
    const Eigen::VectorXd sums  = projected_load(mesh, 1e-6, [](const Eigen::Vector2d &x) { return 1 + x.x(); });
    Eigen::VectorXd       exact = Eigen::VectorXd::Zero(sums.size());
    for (unsigned int t = 0; t < mesh.triangle.size(); ++t)
      for (unsigned int k = 0; k < 3; ++k)
        exact[mesh.triangle[t].cell] += triangle_area(mesh, t) / 3 * (1 + mesh.node[mesh.triangle[t].node[k]].x());
    EXPECT_LT((sums - exact).cwiseAbs().maxCoeff(), 1e-10);
  }

  // In a periodic sample both sides have the same unknowns: a load at the left side spreads to the cells on the right.
  TEST(Projection, JoinsTheSidesOfAPeriodicSample)
  {
    const QuadMesh mesh     = synthetic::box_mesh({0, 0}, {10, 4}, 10, 4);
    const Columns  periodic = projected(mesh, {{0, 2}}, 1, 10), free = projected(mesh, {{0, 2}}, 1);
    double         left = 0, right = 0, right_of_free = 0;
    for (unsigned int k = 0; k < mesh.cell.size(); ++k)
      {
        const double x = cell_centre(mesh, k).x();
        left += x < 1 ? periodic(k, 0) : 0, right += x > 9 ? periodic(k, 0) : 0, right_of_free += x > 9 ? free(k, 0) : 0;
      }
    // A line source has exp(-|x| / l) / (2 l): 1 - exp(-sqrt 2) = 0.757 lies within 1 of it, half on either side. h/l = 1.4
    // allows 10 %.
    EXPECT_NEAR(left, 0.378, 0.04);
    EXPECT_NEAR(right, left, 0.01);
    EXPECT_LT(right_of_free, 1e-4);
  }
} // namespace
