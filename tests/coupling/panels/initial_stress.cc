// diptych: the prepared grains' stress as the continuum's initial stress
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/panels/initial_stress.h"

#include <gtest/gtest.h>

namespace
{
  using namespace diptych;
  using namespace diptych::coupling;

  // Nine-node cells of 1 x 1 over [0, nx] x [0, 2].
  continuum::Snapshot cells(const unsigned int nx)
  {
    const unsigned int  m = 2 * nx + 1;
    continuum::Snapshot s;
    for (unsigned int j = 0; j < 5; ++j)
      for (unsigned int i = 0; i < m; ++i)
        s.position.emplace_back(0.5 * i, 0.5 * j);
    for (unsigned int j = 0; j < 4; j += 2)
      for (unsigned int i = 0; i < 2 * nx; i += 2)
        {
          const unsigned int a = j * m + i;
          s.cells.push_back({{a, a + 2, a + 2 + 2 * m, a + 2 * m, a + 1, a + 2 + m, a + 1 + 2 * m, a + m, a + 1 + m}});
        }
    return s;
  }

  // Two columns of two discs between platens, each carrying the force (0.3, 2) downwards: on the width of one cell that is
  // sigma_yy = 2, sigma_xy = 0.3 (force x, normal y), sigma_yx = 0, so the symmetric part has 0.15.
  TEST(InitialStress, IsTheSymmetricStressOfTheGrainsAndThePressureWhereThereAreNone)
  {
    discrete::Snapshot grains;
    for (const double x : {0.5, 1.5})
      for (const double y : {0.5, 1.5})
        {
          grains.position.emplace_back(x, y);
          grains.radius.push_back(0.5);
          grains.mean_spin_term.push_back(0);
        }
    const Eigen::Vector2d force(0.3, 2);
    for (const int column : {0, 2})
      {
        const double x = column == 0 ? 0.5 : 1.5;
        grains.window_forces.push_back({column, 4, {x, 0}, {0, 1}, force});            // the lower platen's on it
        grains.window_forces.push_back({column, column + 1, {x, 1}, {0, -1}, -force}); // the upper disc's
        grains.window_forces.push_back({column + 1, 5, {x, 2}, {0, -1}, -force});      // the upper platen's
      }
    const auto stress = grain_stress_on_cells(grains, cells(3), 7);
    ASSERT_EQ(stress.size(), 6u);
    Eigen::Matrix2d expected;
    expected << 0, 0.15, 0.15, 2;
    for (const std::size_t k : {0, 1, 3, 4})
      EXPECT_LT((stress[k] - expected).norm(), 1e-12) << "cell " << k;
    for (const std::size_t k : {2, 5}) // beside the grains
      EXPECT_LT((stress[k] - 7 * Eigen::Matrix2d::Identity()).norm(), 1e-12) << "cell " << k;
  }
} // namespace
