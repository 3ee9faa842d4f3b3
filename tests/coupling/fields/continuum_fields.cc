// diptych: tests of the increments of the continuum's cells between two stages
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/fields/continuum_fields.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/coupling/synthetic_samples.h"

namespace
{
  using namespace diptych;
  using namespace diptych::coupling;

  // n x n nine-node cells on the square of side 2. They move by u = t (x, -y) and rotate by t (1 + x + y), x and y in the initial
  // shape.
  continuum::Snapshot squeezed(const int n, const double t)
  {
    continuum::Snapshot s;
    const int           m = 2 * n + 1;
    for (int j = 0; j < m; ++j)
      for (int i = 0; i < m; ++i)
        {
          const Eigen::Vector2d x(2. * i / (m - 1), 2. * j / (m - 1));
          s.displacement.emplace_back(t * x.x(), -t * x.y());
          s.position.emplace_back(x + s.displacement.back());
          s.rotation.push_back(t * (1 + x.x() + x.y()));
        }
    s.cells = synthetic::nine_node_cells(n, n);
    for (int k = 0; k < n * n; ++k)
      {
        continuum::CellState state;
        state.stress.diagonal() = Eigen::Vector3d(1, 2 + t, 1.5);
        state.dissipation       = 10 * t + (k % n < n / 2 ? 0 : 1); // the right half had dissipated more before
        state.couple_stress     = {t, 0};
        s.cell_state.push_back(state);
      }
    return s;
  }

  // From t = 0.1 to 0.2: stress in the middle, dissipation 10 x 0.1. The mean displacement increment is 0.1 (x, -y) at the centre
  // of the initial cell, and the rotation there 0.1 (1 + x + y). The couple stress changes its sign to that of compression.
  void expect_increments(const ContinuumFields &f, const int n)
  {
    for (int k = 0; k < n * n; ++k)
      {
        const Eigen::Vector2d x((k % n + 0.5) * 2 / n, (k / n + 0.5) * 2 / n);
        EXPECT_NEAR(f.stress[k](1, 1), 2.15, 1e-14);
        EXPECT_NEAR(f.dissipation[k], 1, 1e-12);
        EXPECT_NEAR((f.displacement_increment[k] - 0.1 * Eigen::Vector2d(x.x(), -x.y())).norm(), 0, 1e-13);
        EXPECT_NEAR(f.rotation_increment[k], 0.1 * (1 + x.sum()), 1e-13);
        EXPECT_NEAR(f.couple_stress[k].x(), -0.2, 1e-15);
      }
  }

  TEST(ContinuumFields, AreDifferencesOfTheSameCells)
  {
    expect_increments(continuum_fields(squeezed(2, 0.1), squeezed(2, 0.2)), 2);
  }

  TEST(ContinuumFields, DividedCellsTakeTheEarlierValuesOfTheirParents)
  {
    expect_increments(continuum_fields(squeezed(2, 0.1), squeezed(4, 0.2)), 4);
  }

  TEST(ContinuumFields, ALawWithoutRotationHasNoRotationIncrement)
  {
    auto from = squeezed(2, 0.1), to = squeezed(2, 0.2);
    from.rotation.clear(), to.rotation.clear();
    EXPECT_TRUE(std::isnan(continuum_fields(from, to).rotation_increment[0]));
  }
} // namespace
