// diptych: periodic sides: rows across the edge, free and driven widths, images
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/stepping/step_problem.h"
#include "tests/discrete/small_scenes.h"

namespace
{
  using namespace diptych::tests;

  // Platens at 0 and `height`, a cell of the given width.
  State empty_cell(const double width, const double height)
  {
    State state;
    state.walls       = {{{0, 0}, {0, 1}}, {{0, height}, {0, -1}}};
    state.periodicity = PeriodicWidth{width};
    return state;
  }

  // A loose gas of discs of unequal size, some of them many widths away from the cell.
  State gas(const double width, const double height, const int n = 40)
  {
    State                                  state = empty_cell(width, height);
    std::mt19937                           random(7);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const int                              columns = int(width / 1.1);
    for (int k = 0; k < n; ++k)
      {
        add_grain(state.grains, {1.1 * (k % columns), 0.6 + 1.1 * (k / columns)}, 0.45 + 0.1 * uniform(random), 1.);
        state.grains.velocity[k] = {uniform(random), uniform(random)};
        state.grains.spin[k]     = uniform(random);
      }
    return state;
  }

  // Sum over contacts of branch (to the image of j, or to the foot on the wall) times force: area x stress without spin and
  // inertia.
  double moment_xx(const StepResult &result, const State &mid, const double step)
  {
    double sum = 0;
    for (std::size_t k = 0; k < result.contacts.size(); ++k)
      {
        const Contact &c = result.contacts[k];
        if (std::size_t(c.j) >= mid.grains.size())
          continue;
        const double reach = mid.grains.radius[c.i] + mid.grains.radius[c.j] + c.gap;
        sum += reach * c.normal.x() * impulse_vector(c, result.impulses[k]).x() / step;
      }
    return sum;
  }

  // n touching discs of diameter 1 fill the width n. With pressure P on the height H every contact, also that across the edge,
  // carries P H in the very first step, and s_xx = n x 1 x P H / (n H) = P.
  TEST(Periodic, ARowAcrossTheEdgeCarriesThePressureInEveryContact)
  {
    for (const int n : {6, 11})
      {
        const double height = 1.5, pressure = 2, step = 0.02;
        StepSetting  setting    = exact_setting(step);
        State        state      = empty_cell(n, height);
        state.width()->pressure = pressure, state.width()->mass = 3;
        for (int k = 0; k < n; ++k)
          add_grain(state.grains, {k + 0.3 + n * ((k * 7) % 3 - 1), 0.75}, 0.5, 1.); // images a width or two apart
        const StepResult result = advance(state, setting);
        ASSERT_EQ(result.contacts.size(), std::size_t(n));
        for (const Impulse &r : result.impulses)
          EXPECT_NEAR(r.normal / step, pressure * height, 1e-10);
        EXPECT_NEAR(moment_xx(result, state, step) / (n * height), pressure, 1e-10);
        EXPECT_NEAR(state.width()->velocity, 0, 1e-12);
      }
  }

  // The image of a body moves with the width. It meets its neighbour and pushes it along.
  TEST(Periodic, ADrivenWidthMovesImagesByWholeWidths)
  {
    const double step = 0.01, speed = -0.1;
    StepSetting  setting    = exact_setting(step);
    State        state      = empty_cell(5, 1.5);
    state.width()->velocity = speed;
    add_grain(state.grains, {0, 0.75}, 0.5, 1.);
    add_grain(state.grains, {3.95, 0.75}, 0.5, 1.); // 0.05 from the image of the first at 5
    state.grains.fixed[0] = 1;
    for (int k = 0; k < 100; ++k)
      ASSERT_EQ(advance(state, setting).solve.status, SolveStatus::converged);
    // The image of the fixed disc has moved from 5 to 4.9 and pushed the other to 3.9, which moves on with the image.
    EXPECT_NEAR(state.width()->width, 4.9, 1e-13);
    EXPECT_NEAR(state.grains.position[1].x(), 3.9, 1e-12);
    EXPECT_NEAR(state.grains.velocity[1].x(), speed, 1e-13);
  }

  // Sum f_x b_x over contacts = sum_i m_i a_i x_i - W x sum image f_x, because each image is `image` widths away. The width obeys
  // M W'' = -sum image f_x - P H. So area x s_xx = P H W + M W'' W + sum m a x holds in every step of any motion.
  TEST(Periodic, StressOfAFreeWidthIsThePressureUpToInertia)
  {
    const double pressure = 1.5, height = 6, step = 0.02;
    StepSetting  setting     = exact_setting(step);
    setting.law.friction     = 0.4; // the platens stay smooth: their forces have no x component
    setting.solver.tolerance = 1e-12;
    State state              = gas(9, height);
    state.width()->pressure = pressure, state.width()->mass = 20;
    double largest = 0;
    for (int k = 0; k < 150; ++k)
      {
        const State      before = state;
        const StepResult result = advance(state, setting);
        ASSERT_EQ(result.solve.status, SolveStatus::converged);
        double inertia = 0;
        for (std::size_t i = 0; i < state.grains.size(); ++i)
          inertia += state.grains.mass[i] * (state.grains.velocity[i].x() - before.grains.velocity[i].x()) / step *
                     (before.grains.position[i].x() + 0.5 * step * before.grains.velocity[i].x());
        const double width        = before.width()->width + 0.5 * step * before.width()->velocity;
        const double acceleration = (state.width()->velocity - before.width()->velocity) / step;
        const double moment = moment_xx(result, state, step), scale = pressure * height * width + std::abs(moment);
        largest = std::max(largest, moment);
        ASSERT_NEAR(moment, width * (pressure * height + state.width()->mass * acceleration) + inertia, 1e-11 * scale);
      }
    EXPECT_GT(largest, pressure * height * 4) << "the discs must have been pressed together";
  }

  // At rest the inertia terms of the test above vanish: s_xx = P.
  TEST(Periodic, StressOfAPackingAtRestIsThePressure)
  {
    SampleOptions options         = small_sample(100);
    options.width_over_height     = 1;
    options.preparation_tolerance = 1e-8, options.preparation_max_sweeps = 5000;
    options.quiet_unbalanced_force = 1e-5;
    const double         pressure  = 2;
    const PreparedSample sample    = prepare_sample(options, {PeriodicSides{true, 0, 0}, {}, pressure},
                                                    [](int, int) { return true; });
    ASSERT_TRUE(sample.report.quiet);
    const double area = sample_height(sample.state) * sample_width(sample.state);
    EXPECT_NEAR(moment_xx(sample.last_step, sample.state, sample.step) / area, pressure, 1e-4 * pressure);
  }

  // Contacts across the edge transfer momentum like others. A free width is a body; a driven width does work.
  TEST(Periodic, LedgersCloseWithFreeAndWithDrivenWidth)
  {
    for (const bool free : {true, false})
      for (const double e : {0., 0.6})
        {
          StepSetting setting  = exact_setting(0.02);
          setting.law.friction = 0.4, setting.law.platen_friction = 0.5;
          setting.law.normal_restitution = e, setting.law.tangential_restitution = 0.5 * e;
          setting.solver.tolerance = 1e-9; // a single weak contact has an impulse of round-off size
          State state              = gas(9, 6);
          if (free)
            state.width()->pressure = 1.5, state.width()->mass = 20;
          else
            state.width()->velocity = -0.3;
          double work = 0, friction = 0;
          for (int k = 0; k < 150; ++k)
            {
              const StepResult    result = advance(state, setting);
              const StepEnergies &s      = result.energies;
              expect_ledgers(result, 1e-12 * s.kinetic);
              ASSERT_NEAR(s.kinetic, kinetic_energy(state), 1e-12 * s.kinetic);
              work += s.external_work, friction += s.friction_dissipation;
            }
          EXPECT_GT(work, 0.5) << "the width has come in against the discs";
          EXPECT_GT(friction, 0.1);
        }
  }

  // Only differences of abscissae count, and whole widths do not. The path is the same to round-off, which the motion amplifies.
  TEST(Periodic, TranslationsAndWholeWidthsChangeNothing)
  {
    const double width = 9;
    const auto   path  = [&](const double shift, const bool scatter, const bool free) {
      StepSetting setting  = exact_setting(0.02);
      setting.law.friction = 0.4, setting.law.platen_friction = setting.law.normal_restitution = 0.5;
      setting.solver.tolerance = 1e-13;
      State state              = gas(width, 6);
      if (free)
        state.width()->pressure = 1.5, state.width()->mass = 20;
      std::vector<double> offset(state.grains.size(), shift);
      for (std::size_t i = 0; i < offset.size(); ++i)
        {
          offset[i] += scatter ? width * (int(i * 5 % 7) - 3) : 0.;
          state.grains.position[i].x() += offset[i];
        }
      std::size_t contacts = 0;
      for (int k = 0; k < 60; ++k)
        {
          const StepResult result = advance(state, setting);
          EXPECT_EQ(result.solve.status, SolveStatus::converged);
          contacts += result.contacts.size();
        }
      EXPECT_GT(contacts, 1000u);
      for (std::size_t i = 0; i < offset.size(); ++i)
        state.grains.position[i].x() -= offset[i];
      return state;
    };
    for (const bool free : {false, true})
      {
        const State reference = path(0, false, free);
        for (const double shift : {0.3, -7.77, 123.456})
          {
            const State moved = path(shift, !free, free);
            for (std::size_t i = 0; i < reference.grains.size(); ++i)
              {
                EXPECT_NEAR((moved.grains.position[i] - reference.grains.position[i]).norm(), 0, 1e-10) << "shift " << shift;
                EXPECT_NEAR(moved.grains.spin[i], reference.grains.spin[i], 1e-9) << "shift " << shift;
              }
            EXPECT_NEAR(moved.width()->width, reference.width()->width, 1e-11);
          }
      }
  }

  // Six discs in a width of 5.9 overlap by 0.1/6 each. Only a free width can remove this overlap.
  TEST(Periodic, PenetrationsAreRemovedByAFreeWidth)
  {
    StepSetting setting     = exact_setting(0.02);
    State       state       = empty_cell(5.9, 1.5);
    state.width()->pressure = 1, state.width()->mass = 3;
    for (int k = 0; k < 6; ++k)
      add_grain(state.grains, {k * 5.9 / 6, 0.75}, 0.5, 1.);
    double penetration = 1;
    for (int k = 0; k < 50; ++k)
      penetration = advance(state, setting).largest_penetration;
    EXPECT_LT(penetration, 1e-3);
    EXPECT_NEAR(state.width()->width, 6, 6e-3);
  }

  // A grain that met two images of another grain, or its own image, would need two contacts with it.
  TEST(Periodic, ACellTooNarrowIsRefused)
  {
    StepSetting setting = exact_setting(0.01);
    State       state   = empty_cell(2.5, 2);
    add_grain(state.grains, {0, 1}, 0.5, 1.);
    add_grain(state.grains, {1.2, 1}, 0.5, 1.);
    EXPECT_THROW((void)advance(state, setting), std::invalid_argument);
    state.width()->width = 5;
    EXPECT_NO_THROW((void)advance(state, setting));
    state.width()->width = 0;
    EXPECT_THROW(validate_walls(state), std::invalid_argument);
  }
} // namespace
