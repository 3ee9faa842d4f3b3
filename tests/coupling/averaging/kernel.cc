// diptych: tests of the kernel and of the projection
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/averaging/kernel.h"
#include "tests/coupling/averaging/averaging_cases.h"

namespace
{
  using namespace diptych;
  using namespace diptych::coupling;

  // Integral of f(r) 2 pi r dr up to the kernel's reach, from 20000 midpoints, accurate to 1e-8.
  template <class Function> double plane_integral(const double reach, Function &&f)
  {
    constexpr int n   = 20000;
    double        sum = 0;
    for (int k = 0; k < n; ++k)
      {
        const double r = (k + 0.5) * reach / n;
        sum += f(r) * 2 * M_PI * r * reach / n;
      }
    return sum;
  }

  // Lucy: 5/(pi R^2) (1 + 3q)(1 - q)^3 has the integral 10 (1/2 - 6/4 + 8/5 - 3/6) = 1. Half its mean square radius is 5 R^2 (1/4
  // - 1 + 8/7 - 3/8) = 5 R^2 / 56. Gauss loses 9 exp(-8) = 3.0e-3 of the mean square radius beyond 4 w.
  TEST(Kernel, IsNormalisedInThePlaneAndItsWidthIsItsStandardDeviation)
  {
    for (const KernelShape name : {KernelShape::gauss, KernelShape::lucy})
      for (const double w : {0.5, 3.})
        {
          const Kernel kernel(name, w);
          const double cut = name == KernelShape::gauss ? 3.1e-3 : 1e-7;
          EXPECT_NEAR(plane_integral(kernel.reach(), [&](const double r) { return kernel(r * r); }), 1, 1e-7)
            << discrete::name_of(name);
          EXPECT_NEAR(plane_integral(kernel.reach(), [&](const double r) { return 0.5 * r * r * kernel(r * r); }) / (w * w), 1,
                      cut)
            << discrete::name_of(name);
        }
    EXPECT_THROW(Kernel(KernelShape::gauss, -1), std::invalid_argument);
  }

  TEST(Kernel, ArraysAndSinglePointsAgree)
  {
    for (const KernelShape name : {KernelShape::gauss, KernelShape::lucy})
      {
        const Kernel   kernel(name, 0.8);
        Eigen::ArrayXd squares(200);
        for (int k = 0; k < 200; ++k)
          squares[k] = 0.1 * k;
        const Eigen::ArrayXd values = kernel(squares);
        for (int k = 0; k < 200; ++k)
          EXPECT_NEAR(values[k], kernel(squares[k]), 1e-14);
      }
  }

  // Before it is scaled, the sum over cells is the integral of the kernel over the mesh, which is 1 deep inside. It must be so
  // within 1e-3 for widths from a quarter of a cell to more than two cells, also on the most distorted test mesh.
  TEST(Kernel, SumOverCellsDeepInsideIsOne)
  {
    for (const KernelShape name : {KernelShape::gauss, KernelShape::lucy})
      for (const double w : {0.5, 1., 1.5, 2., 3.})
        for (const auto &mesh : synthetic::averaging_meshes())
          {
            const TargetCells         target(mesh.mesh);
            const Kernel              kernel(name, w);
            KernelQuadrature          quadrature(target, kernel);
            KernelQuadrature::Weights weights;
            std::mt19937_64           random(5);
            const double              r = kernel.reach();
            for (int k = 0; k < 300 && r < 10; ++k)
              {
                const double x = synthetic::uniform(random, r, 20 - r);
                quadrature.weights({x, synthetic::uniform(random, r, 30 - r)}, weights);
                EXPECT_NEAR(weights.sum, 1, 1e-3) << discrete::name_of(name) << " " << w << " " << mesh.name;
              }
          }
  }

  // The integral of Gauss over the cell [a, b] x [c, d] is a product of error functions. The quadrature must give the integrals
  // over single cells within 1e-3 of the whole, too.
  TEST(Kernel, IntegralOverACellIsAProductOfErrorFunctions)
  {
    const QuadMesh            mesh = regular_grid({0, 0}, {20, 30}, 2);
    const TargetCells         target(mesh);
    KernelQuadrature          quadrature(target, Kernel(KernelShape::gauss, 1.5));
    KernelQuadrature::Weights weights;
    const Eigen::Vector2d     x(10.3, 14.2);
    quadrature.weights(x, weights);
    const auto part = [](const double from, const double to) {
      return 0.5 * (std::erf(to / (1.5 * std::sqrt(2.))) - std::erf(from / (1.5 * std::sqrt(2.))));
    };
    for (std::size_t k = 0; k < weights.cell.size(); ++k)
      {
        const Eigen::Vector2d &low = mesh.node[mesh.cell[weights.cell[k]][0]], &high = mesh.node[mesh.cell[weights.cell[k]][2]];
        const double           exact = part(low.x() - x.x(), high.x() - x.x()) * part(low.y() - x.y(), high.y() - x.y());
        EXPECT_NEAR(weights.value[k], exact, 1e-3);
      }
  }

  // At a straight side half of the kernel lies outside, and at a corner three quarters. The whole carrier must stay in the mesh.
  TEST(Kernel, ScalesUpTheInnerPartAtTheEdge)
  {
    const QuadMesh            mesh = regular_grid({0, 0}, {20, 30}, 1);
    const TargetCells         target(mesh);
    KernelQuadrature          quadrature(target, Kernel(KernelShape::gauss, 1.));
    KernelQuadrature::Weights weights;
    quadrature.weights({0, 15}, weights);
    EXPECT_NEAR(weights.sum, 0.5, 2e-3);
    quadrature.weights({20, 30}, weights);
    EXPECT_NEAR(weights.sum, 0.25, 2e-3);
    quadrature.weights({-5, 15}, weights);
    EXPECT_EQ(weights.sum, 0);

    Carriers c;
    c.position      = {{0, 15}, {-50, 29.5}};
    c.radius        = {0.5, 0.5};
    c.of_grains     = Columns::Identity(2, 2);
    const auto sums = distribute({AveragingMethod::kernel, KernelShape::gauss, 1}, target, c).of_grains;
    EXPECT_NEAR(sums.col(0).sum(), 1, 1e-13);
    EXPECT_NEAR(sums(29 * 20, 1), 1, 1e-13); // beyond the reach: nearest boundary cell
  }

  TEST(Kernel, RuleAlongASegmentKeepsUniformAndTaperedTotals)
  {
    for (const double length : {0.1, 1., 3.7})
      {
        const SegmentRule rule    = segment_rule(length, 0.9);
        double            uniform = 0, tapered = 0;
        for (std::size_t q = 0; q < rule.t.size(); ++q)
          uniform += rule.weight[q], tapered += rule.weight[q] * 2 * (1 - rule.t[q]);
        EXPECT_NEAR(uniform, 1, 1e-14);
        EXPECT_NEAR(tapered, 1, 1e-14);
      }
    EXPECT_EQ(segment_rule(3.7, 0.9).t.size(), 10u); // five parts of 0.74
  }

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
