// diptych: dissipation of single pairs over a window: closed forms, and agreement with the ledger
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tests/discrete/small_scenes.h"

namespace
{
  using namespace diptych::tests;

  constexpr double g = 10, mu = 0.3, v0 = 3;

  // Two separate discs on a floor (body 2): the first is thrown without spin, the second rolls from the start.
  State thrown_and_rolling()
  {
    State state = disc_on_floor({v0, 0});
    add_grain(state.grains, {-5, 0.5}, 0.5, 1.);
    state.grains.velocity[1] = {2, 0};
    state.grains.spin[1]     = -2 / 0.5;
    return state;
  }

  StepSetting on_the_floor(const double step)
  {
    StepSetting setting         = exact_setting(step, -g);
    setting.law.platen_friction = mu;
    return setting;
  }

  // The angular momentum m r v0 about a point of the floor is constant, so the disc finally rolls at (2/3) v0. It then has (3/4)
  // m v^2 = (1/3) m v0^2 of its initial (1/2) m v0^2: sliding dissipates m v0^2/6. The rolling disc dissipates nothing.
  TEST(WindowDissipation, AThrownDiscLosesAThirdOfItsEnergyAtItsContactARollingOneNothing)
  {
    State             state   = thrown_and_rolling();
    const StepSetting setting = on_the_floor(0.001);
    const double      mass    = state.grains.mass[0];
    WindowForces      window;
    for (int k = 0; k < 600; ++k) // it slides until v0/(3 mu g) = 0.33
      window.add(advance(state, setting), {0., 0.}, setting.step);
    const std::vector<ContactForce> forces      = window.mean_forces(state);
    const std::vector<double>       dissipation = window.dissipation();
    ASSERT_EQ(forces.size(), 2u);
    ASSERT_EQ(dissipation.size(), 2u);
    EXPECT_EQ(forces[0].i, 0);
    EXPECT_NEAR(dissipation[0], mass * v0 * v0 / 6, 1e-12 * mass * v0 * v0);
    EXPECT_NEAR(dissipation[1], 0, 1e-12 * mass * v0 * v0);
    for (const ContactForce &f : forces)
      EXPECT_NEAR(f.force.y(), mass * g, 1e-12 * mass * g);
  }

  // The thrown disc on springs. When sliding ends, the tangential spring holds mu m g, and its energy E = (mu m g)^2/(2 kt)
  // oscillates without loss. So friction dissipates m v0^2/6 - E. Steps add two errors. Sliding starts within a step whose
  // stretch h v0 counts fully: at most kt (h v0)^2/8. It ends within a step: a share of E of the order of omega h, omega = sqrt(3
  // kt/m).
  TEST(WindowDissipation, OnSpringsTheThrownDiscKeepsOnlyWhatTheTangentialSpringHolds)
  {
    const double stiffness = 1e4, kt = 0.5 * stiffness, step = 2e-5;
    State        state = thrown_and_rolling();
    const double mass = state.grains.mass[0], held = std::pow(mu * mass * g, 2) / (2 * kt);
    for (Eigen::Vector2d &x : state.grains.position)
      x.y() -= mass * g / stiffness; // at rest on the normal spring
    StepSetting          setting = on_the_floor(step);
    const PenaltyOptions options{stiffness, 0, 0};
    PenaltyState         springs;
    WindowForces         window;
    for (int k = 0; k < 20000; ++k)
      window.add(advance_penalty(state, springs, setting, options), {0., 0.}, step);
    const std::vector<double> dissipation = window.dissipation();
    ASSERT_EQ(dissipation.size(), 2u);
    const double tolerance = kt * std::pow(step * v0, 2) / 8 + std::sqrt(3 * kt / mass) * step * held; // 0.7 % of E
    EXPECT_NEAR(dissipation[0], mass * v0 * v0 / 6 - held, tolerance);
    EXPECT_EQ(dissipation[1], 0);
  }

  // All pairs of a window dissipate what the ledger gains over it, and all windows together its final value. About 100 steps of
  // 300 contacts are added in another order: 3e4 terms, each rounded to 1e-16 of the sum of their magnitudes.
  void expect_windows_make_up_the_ledger(const Options &options)
  {
    const Course r = loaded(small_sample(150), short_loading(), options);
    ASSERT_EQ(r.report.status, Status::finished) << r.report.message;
    ASSERT_EQ(r.snapshots.size(), 3u);
    EXPECT_EQ(r.snapshots[0].window_dissipation, std::vector<double>(r.snapshots[0].window_forces.size(), 0.));
    const auto expect_ledger = [&](const auto window, const auto ledger) {
      double before = 0;
      for (std::size_t k = 1; k < r.snapshots.size(); ++k)
        {
          const Snapshot            &s    = r.snapshots[k];
          const std::vector<double> &each = s.*window;
          ASSERT_EQ(each.size(), s.window_forces.size());
          const auto   row  = std::find_if(r.rows.begin(), r.rows.end(), [&](const HistoryRow &at) { return at.time == s.time; });
          const double sum  = std::accumulate(each.begin(), each.end(), 0.);
          double       size = 0;
          for (const double x : each)
            size += std::abs(x);
          ASSERT_NE(row, r.rows.end());
          if (options.method.method == Method::nscd)
            {
              EXPECT_GT(sum, 0); // springs store elastic energy and return it
            }
          EXPECT_NEAR(sum, ledger(*row) - before, 3e-12 * (size + before));
          before = ledger(*row);
        }
      EXPECT_EQ(before, ledger(r.rows.back()));
    };
    expect_ledger(&Snapshot::window_dissipation,
                  [](const HistoryRow &row) { return row.friction_dissipation + row.rolling_dissipation; });
    expect_ledger(&Snapshot::window_impact_dissipation, [](const HistoryRow &row) { return row.impact_dissipation; });
    EXPECT_EQ(r.rows.back().rolling_dissipation > 0, options.law.rolling_friction > 0);
    for (const HistoryRow &row : r.rows)
      EXPECT_LT(std::abs(row.energy_residual), 1e-11);
  }

  TEST(WindowDissipation, OfAllPairsIsTheGrowthOfTheLedgersFrictionAndRolling)
  {
    for (const Lateral lateral : {Lateral::end_grains, Lateral::rigid_walls, Lateral::periodic})
      {
        SCOPED_TRACE(name_of(lateral));
        Options options         = quick_options();
        options.lateral.lateral = lateral;
        if (lateral == Lateral::rigid_walls)
          options.law.rolling_friction = options.law.platen_rolling_friction = options.law.wall_rolling_friction = 0.1;
        expect_windows_make_up_the_ledger(options);
      }
  }

  TEST(WindowDissipation, OfAllPairsOnSpringsIsTheGrowthOfTheLedgersFrictionAndRolling)
  {
    Options options              = quick_options();
    options.method.method        = Method::penalty;
    options.law.rolling_friction = 0.1;
    expect_windows_make_up_the_ledger(options);
  }
} // namespace
