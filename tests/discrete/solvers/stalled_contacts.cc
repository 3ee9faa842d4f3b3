// diptych: sweeps that stall on a few contacts
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <limits>

#include "discrete/bodies/boundary.h"
#include "discrete/contacts/contact_law.h"
#include "discrete/panel/loading.h"
#include "discrete/solvers/batched_sweep.h"
#include "discrete/solvers/solver.h"
#include "discrete/solvers/stalled_contacts.h"
#include "tests/discrete/small_scenes.h"

namespace
{
  using namespace diptych::tests;

  ContactRow row(const std::vector<BodyVelocity> &v, const int i, const int j)
  {
    ContactRow c{};
    c.nx = 0, c.ny = 1, c.i = i, c.j = j, c.image_body = -1, c.friction = 0.4;
    c.ki = 2 * v[i].inverse_mass, c.kj = 2 * v[j].inverse_mass, c.jx = c.jy = v[j].inverse_mass;
    c.inverse_wnn = 1 / (v[i].inverse_mass + v[j].inverse_mass), c.inverse_wtt = c.inverse_wnn * disc_wnn_over_wtt;
    return c;
  }

  // Two towers of three discs (mass 1) on a floor: the first falls with velocity 1, the second is at rest.
  ContactProblem towers()
  {
    ContactProblem problem;
    problem.free_velocity = {{0, -1, 0, 1}, {0, -1, 0, 1}, {0, -1, 0, 1}, {0, 0, 0, 1}, {0, 0, 0, 1}, {0, 0, 0, 1}, {0, 0, 0, 0}};
    for (const auto &[i, j] : {std::pair{0, 6}, {1, 0}, {2, 1}, {3, 6}, {4, 3}, {5, 4}})
      problem.contacts.push_back(row(problem.free_velocity, i, j));
    return problem;
  }

  TEST(StalledContacts, LieAroundTheLargestResidual)
  {
    // At r = 0 only the lowest contact of the first tower closes: r - P(r) = 1 there and zero elsewhere. Its free disc has
    // another contact, but with a disc that has no residual.
    const ContactProblem       problem = towers();
    const std::vector<Impulse> zero(6);
    EXPECT_EQ(stalled_contacts(problem, zero, {}), std::vector<int>({0}));
    // Held contacts stay in the set, and the contacts between the bodies of both join it.
    EXPECT_EQ(stalled_contacts(problem, zero, {2}), std::vector<int>({0, 1, 2}));
    EXPECT_EQ(stalled_contacts(problem, zero, {5}), std::vector<int>({0, 5}));
  }

  TEST(StalledContacts, AreNoneIfTheResidualIsEverywhere)
  {
    ContactProblem problem; // 400 discs that fall side by side
    problem.free_velocity.assign(400, {0, -1, 0, 1});
    problem.free_velocity.push_back({0, 0, 0, 0});
    for (int i = 0; i < 400; ++i)
      problem.contacts.push_back(row(problem.free_velocity, i, 400));
    EXPECT_TRUE(stalled_contacts(problem, std::vector<Impulse>(400), {}).empty());
  }

  TEST(StalledContacts, AreSolvedByThemselvesWithAllOthersHeld)
  {
    // The floor stops the first tower: from below, each contact carries the discs above it, 3, 2 and 1.
    const ContactProblem      problem = towers();
    const std::vector<int>    rows{0, 1, 2};
    std::vector<Impulse>      impulses(3);
    std::vector<BodyVelocity> v = problem.free_velocity;
    sweep_alone(problem, rows, v, impulses.data());
    for (int k = 0; k < 3; ++k)
      {
        EXPECT_NEAR(impulses[k].normal, 3 - k, 1e-6);
        EXPECT_NEAR(v[k].y, 0, 1e-6);
        EXPECT_EQ(v[3 + k].y, 0);
      }
  }

  TEST(StalledContacts, HeldRowsAreNotSweptButCountInTheResidual)
  {
    const ContactProblem problem = towers();
    ThreadTeam           one_thread(1);
    BatchedContacts      batches(problem, {0, 1, 2});
    batches.set_impulses(std::vector<Impulse>(6));
    batches.sweep(1, 1, 10, one_thread);
    for (const Impulse &r : batches.impulses())
      EXPECT_EQ(r.normal, 0);
    EXPECT_EQ(batches.residual(one_thread), std::numeric_limits<double>::infinity());
    batches.solve_held([&](std::vector<BodyVelocity> &v, Impulse *impulses) { sweep_alone(problem, {0, 1, 2}, v, impulses); });
    EXPECT_LT(batches.residual(one_thread), 1e-6);
    EXPECT_NEAR(batches.impulses()[0].normal, 3, 1e-6);
    batches.refresh_velocities();
    EXPECT_LT(batches.residual(one_thread), 1e-6);
  }

  // 100 discs are sheared at I = 1e-3 in steps of 0.02. On some of 1700 steps (3.4 % strain) the sweeps circle about a few
  // contacts at residuals of 1e-4. If these are swept by themselves, few such steps remain: 17 of 12000 over eight samples. Which
  // steps remain depends on the last bits.
  TEST(StalledContacts, FewStepsOfAShearedSampleRemainUnsolved)
  {
    SampleOptions options;
    options.grains        = 100;
    PreparedSample sample = prepare_sample(options, {}, [](int, int) { return true; });
    Loading        loading;
    loading.inertial_number = 1e-3;
    start_loading(sample.state, {loading, {}, {}, strain_rate(loading, 1, 1)});
    StepSetting setting;
    setting.step               = 0.02;
    setting.lateral            = EndGrains{};
    setting.solver.tolerance   = 1e-5;
    setting.solver.max_sweeps  = 30000;
    setting.accept_unconverged = true;
    long longest = 0, relieved = 0, left = 0;
    for (int step = 0; step < 1700; ++step)
      {
        const StepResult result = advance(sample.state, setting);
        longest                 = std::max(longest, result.solve.sweeps);
        relieved += result.solve.relieved > 0;
        left += result.solve.status != SolveStatus::converged;
        ASSERT_LT(result.solve.residual, 1e-3) << "step " << step;
      }
    EXPECT_LE(left, 8) << "of " << relieved << " that stalled";
    EXPECT_GT(relieved, 3 * left) << "no step stalled, so this test shows nothing; longest solve " << longest;
  }
} // namespace
