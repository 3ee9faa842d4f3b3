// diptych: every solver on every problem
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include "discrete/contact_law.h"
#include "discrete/solvers/batched_sweep.h"
#include "discrete/solvers/solver.h"
#include "discrete/solvers/sweeps.h"
#include "tests/discrete/small_scenes.h"

namespace
{
  using namespace diptych::tests;

  // Free discs (mass 1) in a triangle pressed onto a floor: small enough that all solvers end at one solution.
  ContactProblem pyramid(const double friction)
  {
    ContactProblem problem;
    const double   c = 0.5, s = std::sqrt(3.) / 2;
    problem.free_velocity = {{0, -1, 0, 1}, {0, -1, 0, 1}, {0.1, -1, 0, 1}, {0, 0, 0, 0}}; // left, right, top, floor
    const auto row        = [&](const int i, const int j, const double nx, const double ny) {
      const double wi = problem.free_velocity[i].inverse_mass, wj = problem.free_velocity[j].inverse_mass;
      problem.contacts.push_back({nx, ny, 0, 0, friction, 1 / (wi + wj), 1 / (3 * (wi + wj)), 2 * wi, 2 * wj, i, j});
    };
    row(0, 3, 0, 1), row(1, 3, 0, 1), row(2, 0, c, s), row(2, 1, -c, s);
    return problem;
  }

  TEST(Solvers, AllReachTheSameSolutionOfASmallProblem)
  {
    for (const double friction : {0., 0.1, 0.5})
      {
        const ContactProblem problem = pyramid(friction);
        std::vector<Impulse> reference;
        for (const std::string solver : {"nsgs", "psor"})
          {
            SolverOptions options;
            options.solver     = solver;
            options.tolerance  = 1e-13;
            options.max_sweeps = 100000;
            std::vector<Impulse> impulses(problem.contacts.size());
            const SolveReport    report = solve(problem, options, impulses);
            EXPECT_EQ(report.status, SolveStatus::converged) << solver << ", friction " << friction;
            EXPECT_LE(natural_map_residual(problem, impulses), 1e-13);
            if (reference.empty())
              reference = impulses;
            for (std::size_t k = 0; k < impulses.size(); ++k)
              {
                EXPECT_NEAR(impulses[k].normal, reference[k].normal, 1e-10) << solver;
                EXPECT_NEAR(impulses[k].tangential, reference[k].tangential, 1e-10) << solver;
              }
          }
        // Vertical momentum: the floor stops all three discs, 3 x 1 x 1, unless friction lets the pile spread.
        if (friction == 0.5)
          {
            EXPECT_NEAR(reference[0].normal + reference[1].normal, 3, 1e-9);
          }
      }
  }

  TEST(Solvers, CoulombAndSignoriniHoldAtTheSolution)
  {
    const ContactProblem problem = pyramid(0.1);
    SolverOptions        options;
    options.tolerance = 1e-13;
    std::vector<Impulse> impulses(problem.contacts.size());
    ASSERT_EQ(solve(problem, options, impulses).status, SolveStatus::converged);
    const std::vector<BodyVelocity> v = velocities(problem, impulses);
    for (std::size_t k = 0; k < impulses.size(); ++k)
      {
        const ContactRow      &c = problem.contacts[k];
        const RelativeVelocity u = relative_velocity(c, v[c.i], v[c.j]);
        EXPECT_GE(impulses[k].normal, 0);
        EXPECT_GE(u.normal, -1e-11);
        EXPECT_NEAR(impulses[k].normal * u.normal, 0, 1e-11);
        EXPECT_LE(std::abs(impulses[k].tangential), c.friction * impulses[k].normal * (1 + 1e-12));
        if (std::abs(impulses[k].tangential) < c.friction * impulses[k].normal * (1 - 1e-9))
          {
            EXPECT_NEAR(u.tangential, 0, 1e-11);
          }
      }
  }

  // Four lanes at a time and one row after another are the same arithmetic in an order that does not matter.
  TEST(Solvers, BatchedSweepsHaveTheBitsOfScalarOnes)
  {
    const ShearedSample sheared = sheared_sample();
    ContactProblem      problem;
    for (std::size_t i = 0; i < sheared.state.grains.size(); ++i)
      problem.free_velocity.push_back(
        {0.01 * double(i % 7), -0.02 * double(i % 5), 0.003 * double(i % 3), 1 / sheared.state.grains.mass[i]});
    problem.free_velocity.insert(problem.free_velocity.end(), 2, {0, 0, 0, 0});
    for (const Contact &c : sheared.result.contacts)
      {
        const double wi = problem.free_velocity[c.i].inverse_mass, wj = problem.free_velocity[c.j].inverse_mass;
        problem.contacts.push_back(
          {c.normal.x(), c.normal.y(), 0.001, 0, 0.4, 1 / (wi + wj), 1 / (3 * (wi + wj)), 2 * wi, 2 * wj, c.i, c.j});
      }
    std::vector<Impulse>      scalar(problem.contacts.size());
    std::vector<BodyVelocity> v = problem.free_velocity, w = v;
    BatchedContacts           batches(problem);
    batches.set_impulses(scalar);
    for (int sweep = 0; sweep < 30; ++sweep)
      {
        sweep_psor(problem, 1.8, 1.0, v, scalar);
        batches.sweep(1.8, 1.0, w);
      }
    const std::vector<Impulse> batched = batches.impulses();
    double                     sum     = 0;
    for (std::size_t k = 0; k < scalar.size(); ++k)
      {
        EXPECT_EQ(scalar[k].normal, batched[k].normal);
        EXPECT_EQ(scalar[k].tangential, batched[k].tangential);
        sum += scalar[k].normal;
      }
    EXPECT_GT(sum, 0);
    for (std::size_t i = 0; i < v.size(); ++i)
      EXPECT_EQ(v[i].x, w[i].x);
    EXPECT_LT(batches.n_batches(), 0.35 * double(scalar.size())) << "most batches should be full";
  }

  // A converged first guess costs one check and no sweep (P7).
  TEST(Solvers, AnEquilibriumCostsNoSweep)
  {
    const ContactProblem problem = pyramid(0.5);
    SolverOptions        options;
    options.tolerance = 1e-10;
    std::vector<Impulse> impulses(problem.contacts.size());
    ASSERT_GT(solve(problem, options, impulses).sweeps, 0);
    EXPECT_EQ(solve(problem, options, impulses).sweeps, 0);
  }

  TEST(Solvers, SayWhenTheyDidNotConverge)
  {
    SolverOptions options;
    options.tolerance            = 1e-14;
    options.max_sweeps           = 3;
    const ContactProblem problem = pyramid(0.5);
    std::vector<Impulse> impulses(problem.contacts.size());
    const SolveReport    report = solve(problem, options, impulses);
    EXPECT_EQ(report.status, SolveStatus::max_sweeps_reached);
    EXPECT_GT(report.residual, 1e-14);
    EXPECT_EQ(report.sweeps, 3);
  }

  TEST(Solvers, AnUnknownNameIsRefused)
  {
    SolverOptions options;
    options.solver = "lemke";
    std::vector<Impulse> none;
    EXPECT_THROW((void)solve({}, options, none), std::invalid_argument);
  }

  // On a real sheared packing (300 discs) plain and over-relaxed sweeps may end at different exact
  // solutions; both must reach one.
  TEST(Solvers, BothConvergeOnAShearedPacking)
  {
    for (const std::string solver : {"nsgs", "psor"})
      {
        ShearedSample sheared             = sheared_sample();
        sheared.setting.solver.solver     = solver;
        sheared.setting.solver.tolerance  = 1e-6;
        sheared.setting.solver.max_sweeps = 400000;
        const StepResult result           = advance(sheared.state, sheared.setting);
        EXPECT_EQ(result.solve.status, SolveStatus::converged) << solver << " residual " << result.solve.residual;
      }
  }
} // namespace
