// diptych: finite increments against rigid rotation and the closed form of simple shear
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>

#include <gtest/gtest.h>

#include "continuum/elements/increment.h"
#include "continuum/equilibrium/point_operations.h"
#include "continuum/laws/elasticity.h"

namespace
{
  using namespace diptych::continuum;

  // A rotation by any angle gives no strain, and the force of a stress on the turned sample is the turned force.
  TEST(Increment, RigidRotationGivesNoStrainAndTurnsTheForce)
  {
    for (const double angle : {0.3, -1.2})
      {
        const double c = std::cos(angle), s = std::sin(angle);
        Motion       motion;
        motion[0] = c - 1, motion[1] = -s, motion[2] = s, motion[3] = c - 1, motion[4] = angle;
        const Increment increment(motion, true);
        EXPECT_LT(increment.strain().norm(), 1e-15);
        EXPECT_NEAR(increment.angle(), angle, 1e-15);

        Stress stress;
        stress[xx] = -1, stress[yy] = -3, stress[xy] = 0.5, stress[relative_rotation] = 0.2, stress[curvature_x] = 0.7;
        const PiolaStress at_start = Increment(Motion(), true).force(stress), now = increment.force(stress);
        for (const unsigned int normal : {0u, 1u})
          {
            EXPECT_NEAR(now[normal], c * at_start[normal] - s * at_start[2 + normal], 1e-14);
            EXPECT_NEAR(now[2 + normal], s * at_start[normal] + c * at_start[2 + normal], 1e-14);
          }
        for (const unsigned int k : {4u, 5u, 6u})
          EXPECT_NEAR(now[k], at_start[k], 1e-14);
      }
  }

  // Hypoelastic simple shear with the Jaumann rate (Dienes, Acta Mech. 32, 1979): s_xy = G sin(shear), s_xx = -s_yy = G (1 -
  // cos(shear)). Twice as many steps leave a quarter of the error.
  TEST(Increment, SimpleShearConvergesToTheClosedFormWithOrderTwo)
  {
    ElasticModuli moduli;
    moduli.shear = 1, moduli.plane_bulk = 1.5;
    const Tangent elastic = elastic_tangent(moduli);
    double        before  = 0;
    for (const int n : {8, 16, 32, 64})
      {
        MaterialState state;
        Motion        motion; // simple shear keeps the gradient from one shape to the next
        motion[1] = 1. / n;
        for (int k = 0; k < n; ++k)
          {
            const Increment increment(motion, true);
            state.stress += elastic * increment.strain();
            turn(state, increment.angle());
          }
        const double error = std::hypot(state.stress[xy] - std::sin(1.), state.stress[xx] - (1 - std::cos(1.)));
        if (n > 8)
          {
            EXPECT_NEAR(before / error, 4, 0.05);
          }
        before = error;
      }
    EXPECT_LT(before, 1e-4);
  }
} // namespace
