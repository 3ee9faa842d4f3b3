// diptych: factors in single precision solve the systems of all elements and constraints to a few digits
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/equilibrium/supernodal_lu.h"
#include "tests/continuum/problem_scenes.h"

namespace
{
  using namespace diptych::continuum;
  using namespace diptych::continuum::tests;

  // Tangents of a softening law, not symmetric, with prescribed, tied and hanging unknowns; then a second matrix on the same
  // pattern.
  TEST(SupernodalLu, SolvesToSinglePrecision)
  {
    Loading rigid = straight_loading(5, {12, -12}, {1});
    rigid.lateral = RigidSides();
    for (const LawKind law : {LawKind::mohr_coulomb, LawKind::cosserat_drucker_prager})
      for (const bool hanging : {false, true})
        {
          const Options        options = with(softening(law), Platens::smooth, Kinematics::updated);
          BoundaryValueProblem problem(rectangle(12, 12, 1.), Units(), rigid, options);
          if (hanging)
            refine_around(problem, {6, 6}, 1);
          SupernodalLu lu;
          for (const double size : {0., 2e-3})
            {
              problem.begin_step(1e-3);
              auto u = random_increment(problem, size, 7);
              problem.impose(u);
              (void)problem.evaluate(u);
              const auto &K = problem.assemble_tangent();
              auto        b = problem.zero_vector(), x = b, r = b;
              for (unsigned int i = 0; i < b.size(); ++i)
                b[i] = std::sin(1. + i);
              b.compress(dealii::VectorOperation::insert);
              ASSERT_TRUE(lu.factorise(K));
              lu.solve(x, b);
              K.vmult(r, x);
              r -= b;
              EXPECT_LT(r.l2_norm(), 2e-3 * b.l2_norm()) << name_of(law) << ", " << hanging << ", " << size;
            }
        }
  }
} // namespace
