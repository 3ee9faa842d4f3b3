// diptych: tests of the kernels' constants in two dimensions, and of their integrals over cells
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/averaging/kernel.h"

#include <cmath>
#include <numeric>
#include <stdexcept>

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
} // namespace
