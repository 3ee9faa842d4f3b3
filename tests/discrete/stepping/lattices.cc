// diptych: the hexagonal lattice of equal discs, at rest and at failure
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/bodies/outline.h"
#include "tests/discrete/small_scenes.h"

namespace
{
  using namespace diptych::tests;

  const double layer = std::sqrt(3.) / 2; // height of a layer, d = 1

  // Rows of `columns` discs (d = 1) at distance `spacing`, between platens. Every second row is shifted by half a spacing so that
  // the rows touch each other. The cell is `columns` spacings wide.
  State lattice(const int columns, const int rows, const double spacing = 1)
  {
    const double b = std::sqrt(1 - 0.25 * spacing * spacing);
    State        state;
    for (int row = 0; row < rows; ++row)
      for (int a = 0; a < columns; ++a)
        add_grain(state.grains, {spacing * (a + 0.5 * (row % 2)), 0.5 + row * b}, 0.5, 1.);
    state.walls         = {{{0, 0}, {0, 1}}, {{0, 1 + (rows - 1) * b}, {0, -1}}};
    state.walls[1].mass = 10;
    state.periodicity   = PeriodicWidth{columns * spacing};
    state.width()->mass = 10;
    return state;
  }

  StepSetting lattice_setting(const double friction)
  {
    StepSetting setting      = exact_setting(0.05);
    setting.law.friction     = friction;
    setting.solver.solver    = ContactSolver::psor;
    setting.solver.tolerance = 1e-12;
    return setting;
  }

  // Rows stretched to a spacing w > 1 do not touch within a row: m x rows discs with 2 m rows contacts, as many as equations. The
  // force of a contact continues along its line, is reflected by the platens and returns to its start. If rows - 1 and m have no
  // common divisor, all lines are one. The only solution is then uniform, N cos a = F/(2 m), sin a = w/2, with F/m at the
  // platens. Every inner disc has s_yy = F/L and s_xx = s_yy tan^2 a (4 half contacts, cell w x b).
  TEST(Lattice, UnderAPlatenForceIsStressedUniformly)
  {
    const int    m = 7, rows = 9;
    const double force = 5, w = 1.1, b = std::sqrt(1 - w * w / 4), length = m * w;
    State        state      = lattice(m, rows, w);
    StepSetting  setting    = lattice_setting(0);
    state.walls[1].drive_y  = AppliedForce{{{0.}, {-force}}};
    const StepResult result = advance(state, setting);
    ASSERT_EQ(result.solve.status, SolveStatus::converged);
    std::vector<Eigen::Vector2d> stress(state.grains.size(), Eigen::Vector2d::Zero());
    for (std::size_t k = 0; k < result.contacts.size(); ++k)
      {
        const Contact &c      = result.contacts[k];
        const double   normal = result.impulses[k].normal / setting.step;
        if (std::size_t(c.j) >= state.grains.size())
          {
            EXPECT_NEAR(normal, force / m, 1e-9);
            continue;
          }
        if (c.gap > 1e-9)
          {
            EXPECT_EQ(normal, 0);
            continue;
          }
        EXPECT_NEAR(normal, force / (2 * m * b), 1e-9);
        const Eigen::Vector2d s = 0.5 * normal * c.normal.cwiseProduct(c.normal) / (w * b);
        stress[c.i] += s, stress[c.j] += s;
      }
    for (int i = m; i < m * (rows - 1); ++i)
      {
        EXPECT_NEAR(stress[i].y(), force / length, 1e-9);
        EXPECT_NEAR(stress[i].x(), force / length * w * w / (4 * b * b), 1e-9);
      }
    EXPECT_NEAR(result.wall_force[0].y(), force, 1e-10);
    EXPECT_NEAR(result.wall_force[1].y(), -force, 1e-10);
  }

  // Touching rows have three contacts per disc. The forces of rigid discs are then not unique, and the solver chooses them. But
  // statics determines the following: each layer transmits F, s_yy = F/L, and s_xx = P if the width is free.
  TEST(Lattice, WithTouchingRowsHoldsWhatStaticsDetermines)
  {
    const int    m = 8, rows = 9;
    const double force = 5, pressure = 2;
    State        state      = lattice(m, rows);
    StepSetting  setting    = lattice_setting(0);
    state.walls[1].drive_y  = AppliedForce{{{0.}, {-force}}};
    state.width()->pressure = pressure;
    const StepResult result = advance(state, setting);
    ASSERT_EQ(result.solve.status, SolveStatus::converged);
    std::vector<double> transmitted(rows - 1, 0.);
    Eigen::Vector2d     moment = Eigen::Vector2d::Zero();
    for (std::size_t k = 0; k < result.contacts.size(); ++k)
      {
        const Contact        &c      = result.contacts[k];
        const double          normal = result.impulses[k].normal / setting.step;
        const Eigen::Vector2d square = normal * c.normal.cwiseProduct(c.normal);
        const bool            wall   = std::size_t(c.j) >= state.grains.size();
        moment += (wall ? 0.5 : 1.) * square;
        if (!wall && std::abs(c.normal.y()) > 0.5)
          transmitted[std::min(c.i, c.j) / m] += normal * std::abs(c.normal.y());
      }
    for (const double f : transmitted)
      EXPECT_NEAR(f, force, 1e-8);
    EXPECT_NEAR(moment.y() / (m * sample_height(state)), force / m, 1e-9);
    EXPECT_NEAR(moment.x() / (m * sample_height(state)), pressure, 1e-9);
    EXPECT_NEAR(state.width()->velocity, 0, 1e-11);
  }

  // Area of disc per cell of the lattice: (pi/4) / (sqrt 3 / 2) = pi/(2 sqrt 3) = 0.9069. The layers of the rows fill the height
  // of the outline except 1 - layer.
  TEST(Lattice, HasTheSolidFractionOfTheDensestPacking)
  {
    const int    m = 8, rows = 10;
    const State  state    = lattice(m, rows);
    const double excess   = (1 - layer) * m;
    const double grains   = m * rows * M_PI / 4;
    const double fraction = grains / (outline_area(make_outline(state, 1.)) - excess);
    EXPECT_NEAR(fraction, M_PI / (2 * std::sqrt(3.)), 1e-12);
    EXPECT_NEAR(fraction, 0.9069, 5e-5);
  }

  // Rowe's lattice: rows across the major stress s1, so that a disc wedges between the two below it. With a free width under P
  // and n rows, n - 1 layers of inclined contacts carry P H, because the rows open. Each layer carries a horizontal force P
  // H/(n-1), where H = 1 + (n-1) layer. The vertical force, F/(2 m), is tan(60 + phi_mu) times that. So at failure
  //   F/(m P) = tan(60 + phi_mu) (sqrt 3 + 2/(n-1)),   sqrt 3 = tan 60.
  double rowe(const double friction, const int rows)
  {
    return std::tan(M_PI / 3 + std::atan(friction)) * (std::tan(M_PI / 3) + 2. / (rows - 1));
  }

  // The lattice is driven: platen, width and rows start on its mechanism, where b^2 + (w/2)^2 = 1 (layer b, spacing w = 1), so db
  // = -dw w/(4 b). Inertia reduces the ratio by terms of the order of (dw/dt)^2, at most 2e-3. Returns F/(m P).
  double stress_ratio_of_driven_lattice(const double friction, const int columns, const int rows)
  {
    const double spread = 1e-2, sink = -spread / (4 * layer); // dw/dt, db/dt
    State        state      = lattice(columns, rows);
    state.width()->pressure = 1;
    state.width()->velocity = spread * columns;
    for (int row = 0; row < rows; ++row)
      for (int a = 0; a < columns; ++a)
        state.grains.velocity[row * columns + a] = {spread * (a + 0.5 * (row % 2)), sink * row};
    state.walls[1].velocity  = {0, sink * (rows - 1)};
    StepSetting setting      = lattice_setting(friction);
    setting.step             = 0.005;
    setting.solver.solver    = ContactSolver::nsgs;
    setting.solver.tolerance = 1e-9;
    const StepResult result  = advance(state, setting);
    if (result.solve.status != SolveStatus::converged)
      return NAN;
    for (const double spin : state.grains.spin)
      EXPECT_LT(std::abs(spin), 0.1 * spread) << "in Rowe's mechanism no disc turns";
    return -result.wall_force[1].y() / columns;
  }

  // In this solution all inclined contacts slide. With friction there are others of lower resistance, in which some discs roll on
  // one side. The over-relaxed solver ends in those: 5.2 to 6.0 at 3 rows and mu = 0.1. Plain sweeps that start without spin from
  // the mechanism stay on Rowe's solution.
  TEST(Lattice, FailsAtRowesStressRatio)
  {
    for (const double friction : {0., 0.1, 0.4})
      {
        const double limit = std::tan(M_PI / 3) * std::tan(M_PI / 3 + std::atan(friction)); // 3.00, 3.84, 12.0
        for (const int rows : {3, 5, 9})
          {
            const double ratio = stress_ratio_of_driven_lattice(friction, 6, rows);
            EXPECT_NEAR(ratio / rowe(friction, rows), 1, 3e-3) << "mu " << friction << ", rows " << rows;
            EXPECT_NEAR(ratio / limit - 1, 2 / std::tan(M_PI / 3) / (rows - 1), 5e-3) << "a correction of order 1/n";
          }
      }
    EXPECT_NEAR(rowe(0, 1000000), 3.00, 0.005);
    EXPECT_NEAR(rowe(0.1, 1000000), 3.84, 0.005);
    EXPECT_NEAR(rowe(0.4, 1000000), 12.0, 0.05);
  }

  // From rest under a platen force. Without friction the limit is sharp: 1 % below it nothing moves, and 1 % above it the platen
  // sinks and the width opens. With friction 0.1 the lattice holds at least up to the frictionless limit, and it flows above
  // Rowe's limit. In between, some solutions hold and some roll. (At 0.4 the sweeps do not converge above the limit.)
  TEST(Lattice, StandsBelowItsLimitAndFlowsAboveIt)
  {
    const int m = 6, rows = 9;
    for (const double friction : {0., 0.1})
      for (const bool above : {false, true})
        {
          State       state        = lattice(m, rows);
          StepSetting setting      = lattice_setting(friction);
          setting.solver.tolerance = above ? 1e-6 : 1e-10; // enough to see the flow
          const double ratio       = above ? 1.01 * rowe(friction, rows) : 0.99 * rowe(0, rows);
          state.width()->pressure  = 1;
          state.walls[1].drive_y   = AppliedForce{{{0.}, {-m * ratio}}};
          for (int k = 0; k < 5; ++k)
            ASSERT_EQ(advance(state, setting).solve.status, SolveStatus::converged) << "mu " << friction << ", ratio " << ratio;
          if (above)
            {
              EXPECT_GT(state.width()->velocity, 1e-5) << "mu " << friction;
              EXPECT_LT(state.walls[1].velocity.y(), -1e-5) << "mu " << friction;
            }
          else
            {
              EXPECT_NEAR(state.width()->velocity, 0, 1e-7) << "mu " << friction;
              EXPECT_NEAR(state.walls[1].velocity.y(), 0, 1e-7) << "mu " << friction;
            }
        }
  }
} // namespace
