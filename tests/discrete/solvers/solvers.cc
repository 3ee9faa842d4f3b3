// diptych: every solver on every problem
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/contacts/natural_map.h"
#include "discrete/contacts/contact_law.h"
#include "discrete/contacts/contact_order.h"
#include "discrete/solvers/batched_sweep.h"
#include "discrete/solvers/solver.h"
#include "discrete/solvers/sweeps.h"
#include "tests/discrete/small_scenes.h"

namespace
{
  using namespace diptych::tests;

  // Free discs (mass 1) in a triangle, pressed onto a floor. This is small enough that all solvers reach the same solution.
  ContactProblem pyramid(const double friction, const double rolling = 0)
  {
    ContactProblem problem;
    const double   c = 0.5, s = std::sqrt(3.) / 2;
    problem.free_velocity = {{0, -1, 0, 1}, {0, -1, 0, 1}, {0.1, -1, 0, 1}, {0, 0, 0, 0}}; // left, right, top, floor
    const auto row        = [&](const int i, const int j, const double nx, const double ny) {
      const double wi = problem.free_velocity[i].inverse_mass, wj = problem.free_velocity[j].inverse_mass;
      problem.contacts.push_back(
               {nx, ny, i, j, 0, -1, 2 * wi, 2 * wj, wj, wj, 0, 0, friction, 1 / (wi + wj), 1 / (wi + wj) * disc_wnn_over_wtt});
    };
    row(0, 3, 0, 1), row(1, 3, 0, 1), row(2, 0, c, s), row(2, 1, -c, s);
    for (ContactRow &each : problem.contacts)
      set_rolling(rolling, each.j == 3 ? 1 : 0.5, each);
    return problem;
  }

  // With couples, many impulses belong to the same motion.
  TEST(Solvers, AllReachTheSameSolutionOfASmallProblem)
  {
    for (const auto &[friction, rolling] : {std::pair{0., 0.}, {0.1, 0.}, {0.5, 0.}, {0.1, 0.2}, {0.5, 0.05}, {0.5, 2.}})
      {
        const ContactProblem problem = pyramid(friction, rolling);
        std::vector<Impulse> reference;
        for (const ContactSolver solver : {ContactSolver::nsgs, ContactSolver::psor})
          {
            SolverOptions options;
            options.solver     = solver;
            options.tolerance  = 1e-13;
            options.max_sweeps = 100000;
            std::vector<Impulse> impulses(problem.contacts.size());
            const SolveReport    report = solve(problem, options, impulses);
            EXPECT_EQ(report.status, SolveStatus::converged) << name_of(solver) << ", friction " << friction;
            EXPECT_LE(natural_map_residual(problem, impulses), 1e-13);
            if (reference.empty())
              reference = impulses;
            const std::vector<BodyVelocity> v = velocities(problem, impulses), expected = velocities(problem, reference);
            for (std::size_t b = 0; b < v.size(); ++b)
              {
                EXPECT_NEAR(v[b].x, expected[b].x, 1e-10) << name_of(solver);
                EXPECT_NEAR(v[b].surface, expected[b].surface, 1e-10) << name_of(solver);
              }
            for (std::size_t k = 0; k < impulses.size() && rolling == 0; ++k)
              {
                EXPECT_NEAR(impulses[k].normal, reference[k].normal, 1e-10) << name_of(solver);
                EXPECT_NEAR(impulses[k].tangential, reference[k].tangential, 1e-10) << name_of(solver);
              }
          }
        // Vertical momentum: the floor stops all three discs, 3 x 1 x 1, unless friction allows the pile to spread.
        if (friction == 0.5)
          {
            EXPECT_NEAR(reference[0].normal + reference[1].normal, 3, 1e-9);
          }
      }
  }

  // The solver checks the residual, and whether to stop, every 20 sweeps. At the third call it has done 40 sweeps. A callback
  // that never stops the solve changes no bit.
  TEST(Solvers, EndBetweenTwoChecksWhenAsked)
  {
    const ContactProblem problem = pyramid(0.1);
    for (const ContactSolver solver : {ContactSolver::nsgs, ContactSolver::psor})
      {
        SolverOptions options;
        options.solver           = solver;
        options.tolerance        = 0;
        options.max_sweeps       = 200;
        options.sweeps_per_check = 20;
        std::vector<Impulse> undisturbed(problem.contacts.size()), asked = undisturbed, stopped = undisturbed;
        (void)solve(problem, options, undisturbed);
        options.stop_requested = [] { return false; };
        (void)solve(problem, options, asked);
        for (std::size_t k = 0; k < undisturbed.size(); ++k)
          EXPECT_TRUE(undisturbed[k].normal == asked[k].normal && undisturbed[k].tangential == asked[k].tangential);
        int questions            = 0;
        options.stop_requested   = [&] { return ++questions == 3; };
        const SolveReport report = solve(problem, options, stopped);
        EXPECT_EQ(report.status, SolveStatus::stopped) << name_of(solver);
        EXPECT_EQ(report.sweeps, 40) << name_of(solver);
      }
  }

  // A problem like that of a step, on a real packing, with artificial terms of the law.
  ContactProblem packing_problem(const int grains, const double tangential_term, const double rolling = 0)
  {
    const PreparedSample sample   = prepare_sample(small_sample(grains), {}, [](int, int) { return true; });
    const auto           contacts = find_contacts(sample.state, std::vector<double>(sample.state.grains.size(), 0.05));
    ContactProblem       problem;
    for (std::size_t i = 0; i < sample.state.grains.size(); ++i)
      problem.free_velocity.push_back(
        {0.01 * double(i % 7), -0.02 * double(i % 5), 0.003 * double(i % 3), 1 / sample.state.grains.mass[i]});
    problem.free_velocity.insert(problem.free_velocity.end(), 2, {0, 0, 0, 0});
    for (const Contact &c : contacts)
      {
        const double wi = problem.free_velocity[c.i].inverse_mass, wj = problem.free_velocity[c.j].inverse_mass;
        const double wnn = 1 / (wi + wj);
        problem.contacts.push_back({c.normal.x(), c.normal.y(), c.i, c.j, 0, -1, 2 * wi, 2 * wj, wj, wj, 0.001,
                                    tangential_term * double(c.i % 3), 0.4, wnn, wnn * disc_wnn_over_wtt});
        const std::vector<double> &r = sample.state.grains.radius;
        set_rolling(rolling, std::size_t(c.j) < r.size() ? r[c.j] / (r[c.i] + r[c.j]) : 1, problem.contacts.back());
      }
    problem.order = sweep_order(contacts, 1.);
    return problem;
  }

  // Four lanes and row after row do the same arithmetic in an order that does not matter. This also holds with several blocks,
  // with tangential restitution and with rolling resistance.
  TEST(Solvers, BatchedSweepsHaveTheBitsOfScalarOnes)
  {
    for (const auto &[tangential_term, rolling] : {std::pair{0., 0.}, {0.002, 0.}, {0., 0.1}, {0.002, 0.1}})
      {
        const ContactProblem      problem = packing_problem(2000, tangential_term, rolling);
        std::vector<Impulse>      scalar(problem.contacts.size());
        std::vector<BodyVelocity> v = problem.free_velocity;
        ThreadTeam                team(1);
        BatchedContacts           batches(problem);
        EXPECT_GT(batches.n_blocks(), 1u);
        batches.set_impulses(scalar);
        for (int sweep = 0; sweep < 30; ++sweep)
          sweep_psor(problem, batches.order(), 1.8, 1.0, v, scalar);
        batches.sweep(1.8, 1.0, 30, team);
        const std::vector<Impulse> batched = batches.impulses();
        double                     sum = 0, couples = 0;
        for (std::size_t k = 0; k < scalar.size(); ++k)
          {
            EXPECT_EQ(scalar[k].normal, batched[k].normal);
            EXPECT_EQ(scalar[k].tangential, batched[k].tangential);
            EXPECT_EQ(scalar[k].rolling, batched[k].rolling);
            sum += scalar[k].normal;
            couples += std::abs(scalar[k].rolling);
          }
        EXPECT_GT(sum, 0);
        EXPECT_EQ(couples > 0, rolling > 0);
        EXPECT_LT(batches.n_batches(), 0.3 * double(scalar.size())) << "most batches should be full";
        batches.refresh_velocities();
        EXPECT_NEAR(batches.residual(team), natural_map_residual(problem, scalar), 1e-12);
      }
  }

  TEST(Solvers, EveryNumberOfThreadsGivesTheSameBits)
  {
    const ContactProblem problem = packing_problem(2000, 0, 0.1);
    SolverOptions        options;
    options.tolerance  = 1e-14;
    options.max_sweeps = 1000;
    std::vector<std::vector<Impulse>> results;
    for (const int threads : {1, 2, 3, 4})
      {
        ThreadTeam           team(threads);
        std::vector<Impulse> impulses(problem.contacts.size());
        EXPECT_EQ(solve(problem, options, impulses, team).sweeps, 1000);
        results.push_back(impulses);
      }
    for (const std::vector<Impulse> &result : results)
      for (std::size_t k = 0; k < result.size(); ++k)
        {
          EXPECT_EQ(result[k].normal, results[0][k].normal);
          EXPECT_EQ(result[k].tangential, results[0][k].tangential);
          EXPECT_EQ(result[k].rolling, results[0][k].rolling);
        }
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

  TEST(Solvers, ReportThatTheyDidNotConverge)
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

  // On a real sheared packing (300 discs) plain and over-relaxed sweeps may reach different exact solutions, but both must reach
  // one.
  TEST(Solvers, BothConvergeOnAShearedPacking)
  {
    for (const ContactSolver solver : {ContactSolver::nsgs, ContactSolver::psor})
      {
        ShearedSample sheared             = sheared_sample();
        sheared.setting.solver.solver     = solver;
        sheared.setting.solver.tolerance  = 1e-6;
        sheared.setting.solver.max_sweeps = 400000;
        const StepResult result           = advance(sheared.state, sheared.setting);
        EXPECT_EQ(result.solve.status, SolveStatus::converged) << name_of(solver) << " residual " << result.solve.residual;
      }
  }
} // namespace
