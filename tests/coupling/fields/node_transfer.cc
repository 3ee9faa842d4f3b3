// diptych: tests of displacement increments between different meshes
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/fields/node_transfer.h"

#include <cmath>
#include <functional>
#include <stdexcept>

#include <gtest/gtest.h>

#include "coupling/fields/strain_increment.h"
#include "tests/coupling/synthetic_samples.h"

namespace
{
  using namespace diptych;
  using namespace diptych::coupling;

  using Field = std::function<Eigen::Vector2d(const Eigen::Vector2d &)>;

  // n x n nine-node cells of a quadrilateral with straight edges that are not parallel, moved by a displacement.
  continuum::Snapshot grid(const int n, const Field &displacement)
  {
    const Eigen::Vector2d corner[4] = {{0, 0}, {4, 0.5}, {3.5, 3}, {-0.5, 2.5}};
    const int             m         = 2 * n + 1;
    continuum::Snapshot   s;
    for (int j = 0; j < m; ++j)
      for (int i = 0; i < m; ++i)
        {
          const double          a = double(i) / (m - 1), b = double(j) / (m - 1);
          const Eigen::Vector2d x = (1 - a) * (1 - b) * corner[0] + a * (1 - b) * corner[1] + a * b * corner[2] +
                                    (1 - a) * b * corner[3];
          s.displacement.push_back(displacement(x));
          s.position.emplace_back(x + s.displacement.back());
          s.weight.push_back(1);
        }
    s.cells = synthetic::nine_node_cells(n, n);
    return s;
  }

  // The displacement is so large that a search at the deformed places would find other cells.
  Eigen::Vector2d affine(const Eigen::Vector2d &x)
  {
    return {0.7 + 0.3 * x.x() - 0.2 * x.y(), -0.4 + 0.1 * x.x() - 0.5 * x.y()};
  }

  TEST(NodeTransfer, ReproducesAnAffineFieldAtTheNodesOfAFinerMesh)
  {
    const auto from = grid(3, affine), to = grid(6, [](const Eigen::Vector2d &x) { return Eigen::Vector2d(2 * affine(x)); });
    const auto found = displacement_at_nodes_of(from, to);
    ASSERT_EQ(found.size(), to.position.size());
    for (std::size_t k = 0; k < found.size(); ++k)
      EXPECT_LT((found[k] - affine(to.position[k] - to.displacement[k])).norm(), 1e-12);
    const DisplacementField field = displacement_field(from, to); // 2 u - u
    for (std::size_t k = 0; k < found.size(); ++k)
      EXPECT_LT((field.increment[k] - found[k]).norm(), 1e-12);
  }

  // On cells of a unit square the quadratic x y is one of the biquadratic functions.
  TEST(NodeTransfer, DividedCellsKeepTheBiquadraticField)
  {
    const auto square = [](const int n) {
      continuum::Snapshot s = grid(n, [](const Eigen::Vector2d &) { return Eigen::Vector2d(0, 0); });
      const int           m = 2 * n + 1;
      for (int k = 0; k < m * m; ++k)
        {
          const double x = double(k % m) / (m - 1), y = double(k / m) / (m - 1);
          s.displacement[k] = {x * x * y * y - y, 3 * x * y * y};
          s.position[k]     = Eigen::Vector2d(x, y) + s.displacement[k];
        }
      return s;
    };
    const auto from = square(2), to = square(8), back = square(2);
    const auto found = displacement_at_nodes_of(from, to);
    for (std::size_t k = 0; k < found.size(); ++k)
      EXPECT_LT((found[k] - to.displacement[k]).norm(), 1e-12);
    EXPECT_EQ(displacement_at_nodes_of(from, back), from.displacement); // for the same mesh, its own nodes bit by bit
  }

  TEST(NodeTransfer, RejectsANodeOutsideTheEarlierMesh)
  {
    const auto from = grid(2, affine);
    auto       to   = grid(3, affine);
    to.position.back() += Eigen::Vector2d(1, 1);
    EXPECT_THROW(displacement_at_nodes_of(from, to), std::invalid_argument);
  }
} // namespace
