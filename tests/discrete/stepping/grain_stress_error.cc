// diptych: estimated and true error of grain stress
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <iostream>

#include "discrete/stepping/grain_stress_error.h"
#include "discrete/stepping/step_problem.h"
#include "discrete/stepping/warm_start.h"
#include "tests/discrete/small_scenes.h"

namespace
{
  using namespace diptych::tests;

  constexpr double infinity = std::numeric_limits<double>::infinity();

  // Two discs of radius 0.5 and 1 on top of each other overlap by 0.1. The normal from the upper (j) to the lower (i) is n = (0,
  // -1), the arms are 0.45 and 0.95. With r_n = 2, r_t = 1 the tangent is n turned by +90 degrees, (1, 0), so r = (1, -2) and M_i
  // = 0.45 n (x) r = [[0, 0], [-0.45, 0.9]], M_j = 0.95 n (x) r = [[0, 0], [-0.95, 1.9]].
  TEST(ContactMoments, OfTwoDiscsByHand)
  {
    const std::vector<double>  radius   = {0.5, 1};
    const std::vector<Contact> contacts = {{0, 1, -0.1, {0, -1}, {0, 0.5}, 0}};
    const std::vector<double>  m        = contact_moments(radius, contacts, {{2, 1}});
    const std::vector<double>  expected = {0, 0, -0.45, 0.9, 0, 0, -0.95, 1.9};
    ASSERT_EQ(m.size(), expected.size());
    for (std::size_t k = 0; k < m.size(); ++k)
      EXPECT_NEAR(m[k], expected[k], 1e-15);
  }

  // A platen has no moment, and an open contact contributes none.
  TEST(ContactMoments, OfAPlatenAndOfAnOpenContact)
  {
    const std::vector<Contact> contacts = {{0, 1, 0., {0, 1}, {0, 0}, 0}, {0, 2, 0.2, {1, 0}, {0, 0}, 0}};
    EXPECT_EQ(contact_moments({0.5}, contacts, {{4, 0}, {0, 0}}), (std::vector<double>{0, 0, 0, 2}));
  }

  TEST(RelativeDifference, IsThatOfTheNorms)
  {
    EXPECT_DOUBLE_EQ(relative_difference({3, 4}, {0, 0.5}), std::sqrt(9 + 3.5 * 3.5) / 0.5);
    EXPECT_EQ(relative_difference({0, 0}, {0, 0}), 0);
    EXPECT_EQ(relative_difference({1, 0}, {0, 0}), infinity);
  }

  // Moments that consist of one number, sample after sample.
  GrainStressError observed(const std::vector<double> &values)
  {
    GrainStressError error;
    for (const double value : values)
      error.observe({value});
    return error;
  }

  TEST(GrainStressError, WantsMomentsAtDoublingSweeps)
  {
    GrainStressError  error;
    std::vector<long> taken;
    for (long sweeps = 0; sweeps <= 2000; sweeps += 20)
      if (error.wants(sweeps))
        error.observe({1. / double(sweeps)}), taken.push_back(sweeps);
    EXPECT_EQ(taken, (std::vector<long>{100, 200, 400, 800, 1600}));
  }

  // The changes 0.08, 0.04, 0.02 halve: q = 0.5 counts as 0.7, so E = 4 x 0.02 x 0.7 / 0.3, while the true rest is 0.02.
  TEST(GrainStressError, SumsTheRestOfAGeometricSeries)
  {
    EXPECT_NEAR(observed({0.84, 0.92, 0.96, 0.98, 0.99, 0.995, 0.9975, 1}).change(), 0.0025, 1e-12);
    const GrainStressError three = observed({1.14, 1.06, 1.02, 1});
    EXPECT_NEAR(three.change(), 0.02, 1e-12);
    EXPECT_NEAR(three.estimate(), 4 * 0.02 * 0.7 / 0.3, 1e-12);
  }

  TEST(GrainStressError, IsUnknownWithTooFewSamplesAndIfTheChangesDoNotShrink)
  {
    EXPECT_EQ(observed({}).estimate(), infinity);
    EXPECT_EQ(observed({2, 1.5}).estimate(), infinity);
    EXPECT_EQ(observed({2, 1.5, 1.2}).estimate(), infinity);
    EXPECT_EQ(observed({1.03, 1.02, 1.01, 1}).estimate(), infinity) << "equal changes";
    EXPECT_EQ(observed({1.31, 1.01, 1.005, 1}).estimate(), infinity) << "one change that shrank and one that did not";
    EXPECT_EQ(observed({1, 1, 1, 1}).estimate(), 0) << "nothing moves";
  }

  // The contact problem of the next step of a loading, as the time stepping makes it.
  struct StoredStep
  {
    State                state; // at mid-step
    std::vector<Contact> contacts;
    ContactProblem       problem;
    std::vector<Impulse> first;

    SampledProblem      sampled() const { return {problem, state.grains.radius, contacts}; }
    std::vector<double> moments(const std::vector<Impulse> &r) const { return contact_moments(state.grains.radius, contacts, r); }
  };

  StoredStep next_step(const State &now, const StepSetting &setting)
  {
    StoredStep step{now, {}, {}, {}};
    for (std::size_t i = 0; i < now.grains.size(); ++i)
      step.state.grains.position[i] += 0.5 * setting.step * now.grains.velocity[i];
    for (Wall &wall : step.state.walls)
      wall.point += 0.5 * setting.step * wall.velocity;
    const std::vector<Eigen::Vector2d> force = applied_forces(step.state, setting);
    const std::vector<BodyVelocity>    v     = body_velocities(step.state);
    step.contacts                            = find_contacts(step.state, std::vector<double>(now.grains.size(), 0.05));
    step.problem = make_problem(step.state, setting, step.contacts, v, {free_velocities(step.state, v, force, setting), {}, {}});
    FirstGuess guess = first_guess(now.impulses, step.contacts);
    step.first       = std::move(guess.impulses);
    extrapolate(step.problem, guess.changes, step.first);
    return step;
  }

  // Steps of a sample of 300 discs, sheared at inertial number 1e-3 with h = 0.02. They are 0.2 % of strain apart.
  std::vector<StoredStep> sheared_steps(const int seed, const int n_steps)
  {
    PreparedSample sample  = prepare_sample(small_sample(300, seed), {}, [](int, int) { return true; });
    const Loading  loading = short_loading();
    start_loading(sample.state, {loading, {}, {}, strain_rate(loading, 1., 1.)});
    for (PairImpulse &r : sample.state.impulses)
      r.normal *= 0.02 / sample.step, r.tangential *= 0.02 / sample.step;
    StepSetting setting;
    setting.step               = 0.02;
    setting.lateral            = EndGrains{};
    setting.solver.tolerance   = 1e-4;
    setting.solver.max_sweeps  = 4000;
    setting.accept_unconverged = true; // some steps of so few grains do not converge; the next problem serves as well
    StepCache               cache;
    std::vector<StoredStep> steps;
    for (int k = 1; k <= 100 * n_steps; ++k)
      {
        (void)advance(sample.state, setting, cache);
        if (k % 100 == 0)
          steps.push_back(next_step(sample.state, setting));
      }
    return steps;
  }

  // One sampled solve and its distance from a solution at 1e-9.
  struct Trial
  {
    SolveReport     report;
    SampledAccuracy accuracy;
    double          true_error = 0;
  };

  SampleRequest request_of(const double accuracy, const int max_sweeps)
  {
    SampleRequest request;
    request.options.snapshot_accuracy   = accuracy;
    request.options.snapshot_max_sweeps = max_sweeps;
    return request;
  }

  Trial trial_of(const StoredStep &step, const std::vector<double> &truth, const SampleRequest &request)
  {
    Trial                trial;
    ThreadTeam           one_thread(1);
    std::vector<Impulse> r = step.first;
    trial.report           = solve_sampled(step.sampled(), SolverOptions{}, request, one_thread, r, trial.accuracy);
    trial.true_error       = relative_difference(step.moments(r), truth);
    return trial;
  }

  struct Statistics
  {
    int                 n_problems = 0, n_solved = 0, n_trials = 0, n_reached = 0;
    int                 n_right = 0; // solves that were correctly called accurate
    std::vector<double> ratio;       // true error / estimate, if there is an estimate
  };

  Statistics measured(const std::vector<double> &wanted)
  {
    Statistics    s;
    SolverOptions fully;
    fully.tolerance  = 1e-9;
    fully.max_sweeps = 300000;
    for (const int seed : {1, 2, 3, 4, 5, 6, 7, 8})
      for (const StoredStep &step : sheared_steps(seed, 4))
        {
          ++s.n_problems;
          std::vector<Impulse> solution = step.first;
          if (solve(step.problem, fully, solution).status != SolveStatus::converged)
            continue;
          ++s.n_solved;
          const std::vector<double> truth = step.moments(solution);
          for (const double accuracy : wanted)
            {
              const Trial t = trial_of(step, truth, request_of(accuracy, 50000));
              EXPECT_EQ(t.accuracy.reached, t.accuracy.stress_error <= accuracy);
              ++s.n_trials, s.n_reached += t.accuracy.reached;
              s.n_right += t.accuracy.reached && t.true_error <= accuracy;
              if (std::isfinite(t.accuracy.stress_error) && t.accuracy.stress_error > 0)
                s.ratio.push_back(t.true_error / t.accuracy.stress_error);
            }
        }
    std::sort(s.ratio.begin(), s.ratio.end());
    return s;
  }

  // The measured distribution is in the output and in benchmarks/contact_solver.
  TEST(GrainStressError, EstimateAgainstTheTruthOnShearedSamples)
  {
    const Statistics s = measured({0.1, 0.05, 0.02});
    ASSERT_GE(s.n_solved, 5) << "too few solutions at 1e-9 to compare with";
    ASSERT_GE(s.ratio.size(), 5u);
    const auto quantile = [&](const double share) { return s.ratio[std::size_t(share * double(s.ratio.size() - 1))]; };
    std::cout << s.n_solved << " of " << s.n_problems << " steps solved to 1e-9; " << s.ratio.size() << " of " << s.n_trials
              << " solves with an estimate, " << s.n_reached << " called as accurate as wanted, " << s.n_right
              << " rightly; true error / estimate: median " << quantile(0.5) << ", 90 % " << quantile(0.9) << ", largest "
              << s.ratio.back() << "\n";
    // Occasionally the sweeps pause near a state that is not a solution and leave it much later.
    EXPECT_GE(s.n_right, 0.85 * s.n_reached);
    EXPECT_LE(quantile(0.5), 0.5);
  }

  TEST(SolveSampled, AUsedUpBudgetIsReportedAndNotCalledAccurate)
  {
    const StoredStep step = sheared_steps(1, 1).front();
    const Trial      t    = trial_of(step, step.moments(step.first), request_of(1e-6, 400));
    EXPECT_EQ(t.report.status, SolveStatus::converged) << "the step still meets its tolerance";
    EXPECT_LE(t.report.residual, SolverOptions{}.tolerance);
    EXPECT_GE(t.report.sweeps, 400);
    EXPECT_FALSE(t.accuracy.reached);
    EXPECT_GT(t.accuracy.stress_error, 1e-6);
  }

  TEST(SolveSampled, ATooSmallBudgetOfTheStepPreventsConvergence)
  {
    const StoredStep     step = sheared_steps(1, 1).front();
    SolverOptions        solver;
    SampledAccuracy      accuracy;
    ThreadTeam           one_thread(1);
    std::vector<Impulse> r(step.contacts.size());
    solver.max_sweeps        = 40;
    const SolveReport report = solve_sampled(step.sampled(), solver, request_of(0.02, 40), one_thread, r, accuracy);
    EXPECT_EQ(report.status, SolveStatus::max_sweeps_reached);
    EXPECT_GT(report.residual, solver.tolerance);
    EXPECT_FALSE(accuracy.reached);
  }

  // The tolerance is below 1e-9: the step has not converged before it meets its own tolerance.
  TEST(SolveSampled, ATighterToleranceThanTheReferenceHolds)
  {
    SolverOptions solver;
    solver.solver       = ContactSolver::nsgs;
    solver.tolerance    = 1e-12;
    solver.max_sweeps   = 1000000;
    State       state   = disc_on_floor({0, 0});
    StepSetting setting = exact_setting(0.1);
    for (int k = 1; k < 6; ++k)
      add_grain(state.grains, {0, 0.5 + k}, 0.5, 1.);
    setting.stepping.gravity_y = -1;
    const StoredStep     step  = next_step(state, setting);
    std::vector<Impulse> r(step.contacts.size());
    SampledAccuracy      accuracy;
    ThreadTeam           one_thread(1);
    solver.sweeps_per_check  = 1;
    const SolveReport report = solve_sampled(step.sampled(), solver, request_of(0.02, 100000), one_thread, r, accuracy);
    EXPECT_EQ(report.status, SolveStatus::converged);
    EXPECT_LE(report.residual, solver.tolerance);
  }

  TEST(SolveSampled, AFinishedSolveHasNoErrorAndTheFactorIsMeasuredAgainstIt)
  {
    const StoredStep step            = sheared_steps(1, 1).front();
    SampleRequest    request         = request_of(1e-6, 200);
    request.measure_factor           = true;
    request.options.reference_sweeps = 100000;
    const Trial vain                 = trial_of(step, step.moments(step.first), request);
    EXPECT_FALSE(vain.accuracy.reached);
    EXPECT_TRUE(std::isnan(vain.accuracy.true_error)) << "nothing is measured if the accuracy was not reached";

    request.options.snapshot_accuracy   = std::numeric_limits<double>::infinity();
    request.options.snapshot_max_sweeps = 2000;
    const Trial t                       = trial_of(step, step.moments(step.first), request);
    ASSERT_TRUE(t.accuracy.reached);
    EXPECT_GT(t.accuracy.true_error, 0);
    if (t.accuracy.reference_residual <= 0.1 * t.report.residual)
      EXPECT_NEAR(t.accuracy.error_over_residual, t.accuracy.true_error / t.report.residual,
                  1e-9 * t.accuracy.error_over_residual);
    else
      EXPECT_TRUE(std::isnan(t.accuracy.error_over_residual));
  }
} // namespace
