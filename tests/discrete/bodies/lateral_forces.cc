// diptych: Moreau's containing action
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include "discrete/bodies/boundary.h"
#include "tests/discrete/small_scenes.h"

namespace
{
  using namespace diptych::tests;

  TEST(LateralForces, EachBandCarriesItsShareOfThePressureOnFiveGrainsASide)
  {
    const PreparedSample         sample = prepare_sample(small_sample(500), {}, [](int, int) { return true; });
    const State                 &state  = sample.state;
    std::vector<Eigen::Vector2d> force(state.grains.size(), Eigen::Vector2d::Zero());
    const double                 pressure = 2.5;
    add_lateral_forces(state, EndGrains{3., 5}, pressure, 1., force);

    const double height  = state.walls[1].point.y();
    const int    n_bands = int(std::lround(height / 3));
    double       left = 0, right = 0;
    int          loaded = 0;
    for (std::size_t i = 0; i < force.size(); ++i)
      {
        EXPECT_EQ(force[i].y(), 0);
        loaded += force[i].x() != 0;
        (force[i].x() > 0 ? left : right) += force[i].x();
      }
    EXPECT_EQ(loaded, 10 * n_bands);
    EXPECT_NEAR(left, pressure * height, 1e-10 * left);
    EXPECT_NEAR(right, -pressure * height, 1e-10 * left);

    // Within one band and side the forces are proportional to the masses.
    const double w     = height / n_bands;
    double       ratio = 0;
    for (std::size_t i = 0; i < force.size(); ++i)
      if (state.grains.position[i].y() < w && force[i].x() > 0)
        {
          if (ratio == 0)
            ratio = force[i].x() / state.grains.mass[i];
          EXPECT_NEAR(force[i].x() / state.grains.mass[i], ratio, 1e-12 * ratio);
        }
    EXPECT_GT(ratio, 0);
  }
} // namespace
