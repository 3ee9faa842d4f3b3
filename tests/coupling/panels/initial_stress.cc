// diptych: tests of the initial stress of the continuum from the prepared grains
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/panels/initial_stress.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "tests/coupling/synthetic_samples.h"

namespace
{
  using namespace diptych;
  using namespace diptych::coupling;

  // Nine-node cells of 1 x 1 over [0, nx] x [0, ny].
  continuum::Snapshot cells(const unsigned int nx, const unsigned int ny = 2)
  {
    continuum::Snapshot s;
    for (unsigned int j = 0; j < 2 * ny + 1; ++j)
      for (unsigned int i = 0; i < 2 * nx + 1; ++i)
        s.position.emplace_back(0.5 * i, 0.5 * j);
    s.cells = synthetic::nine_node_cells(nx, ny);
    return s;
  }

  // Two columns of two discs between platens, each carrying the force (0.3, 2) downwards. On the width of one cell this is
  // sigma_yy = 2, sigma_xy = 0.3 (force x, normal y) and sigma_yx = 0, so the symmetric part has 0.15.
  TEST(InitialStress, IsTheGrainsSymmetricStressOrThePressureWithoutGrains)
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
        grains.window_forces.push_back({column, 4, {x, 0}, {0, 1}, force});            // force of the lower platen
        grains.window_forces.push_back({column, column + 1, {x, 1}, {0, -1}, -force}); // force of the upper disc
        grains.window_forces.push_back({column + 1, 5, {x, 2}, {0, -1}, -force});      // force of the upper platen
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

  // One disc per cell, larger ones on the left; one in ten is missing. The field must follow the two halves and not the single
  // holes.
  TEST(InitialSolidFraction, FollowsTheSampleAndNotSingleGrains)
  {
    const unsigned int  n = 40;
    discrete::Snapshot  grains;
    std::mt19937        random(1);
    std::vector<double> cell_by_cell;
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < n; ++i)
        {
          cell_by_cell.push_back(0);
          if (random() % 10 == 0)
            continue;
          grains.position.emplace_back(i + 0.5, j + 0.5);
          grains.radius.push_back(i < n / 2 ? 0.5 : 0.45);
          cell_by_cell.back() = M_PI * grains.radius.back() * grains.radius.back();
        }
    grains.area         = n * n;
    const auto fraction = grain_solid_fraction_on_cells(grains, cells(n, n));
    double     mean = 0, expected = 0;
    for (std::size_t k = 0; k < fraction.size(); ++k)
      mean += fraction[k] / double(n * n), expected += cell_by_cell[k] / double(n * n);
    EXPECT_NEAR(mean, expected, 1e-12);
    for (const bool left : {true, false})
      {
        double own = 0, squares = 0;
        int    cells_seen = 0;
        for (unsigned int j = 6; j < n - 6; ++j)
          for (unsigned int i = left ? 6 : n / 2 + 6; i < (left ? n / 2 - 6 : n - 6); ++i, ++cells_seen)
            own += fraction[j * n + i], squares += std::pow(fraction[j * n + i], 2);
        own /= cells_seen;
        EXPECT_NEAR(own, (left ? M_PI / 4 : 0.81 * M_PI / 4) * 0.9, 0.02) << left;
        EXPECT_LT(std::sqrt(squares / cells_seen - own * own), 0.05) << "single cells scatter by 0.24";
      }
  }
} // namespace
