// diptych: explicit smooth contacts: the step at which a packing blows up
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tests/discrete/stepping/penalty_examples.h"

namespace
{
  // n x n touching discs in a hexagonal lattice shrunk by `strain`, the outermost ring fixed. Each inner grain has six equal
  // forces, so the lattice is in equilibrium.
  State hexagonal_patch(const int n, const double strain)
  {
    State        state;
    const double a = 1 - strain;
    for (int row = 0; row < n; ++row)
      for (int k = 0; k < n; ++k)
        {
          add_grain(state.grains, {a * (k + 0.5 * (row % 2)), a * row * std::sqrt(0.75)}, 0.5, 1.);
          state.grains.fixed.back() = row == 0 || row == n - 1 || k == 0 || k == n - 1;
        }
    return state;
  }

  // Discs with radii uniform in [0.35, 0.65] d, relaxed in a square box until the overlaps are in equilibrium.
  State relaxed_polydisperse_box(const int n, const double solid_fraction, const unsigned seed)
  {
    State                                  state;
    std::mt19937                           random(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<double>                    radius(n);
    double                                 area = 0;
    for (double &r : radius)
      {
        r = 0.35 + 0.3 * uniform(random);
        area += M_PI * r * r;
      }
    const double side = std::sqrt(area / solid_fraction);
    add_box(state, side, side);
    for (const double r : radius)
      {
        const double x = r + (side - 2 * r) * uniform(random), y = r + (side - 2 * r) * uniform(random);
        add_grain(state.grains, {x, y}, r, 1.);
      }
    (void)relax_soft_discs(state, 0., 20000);
    return state;
  }

  // Highest frequency of the network of closed contacts. K = sum kn b_n b_n^T + kt b_t b_t^T over (x, y, s = r theta) of each
  // grain, with u_n = b_n.v and u_t = b_t.v of ContactRow and masses (m, m, m/2). The prestress changes K only by
  // overlap/diameter.
  double highest_frequency(const State &state, const double kn, const double kt)
  {
    const Grains   &g = state.grains;
    const int       n = int(g.size());
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(3 * n, 3 * n);
    for (const Contact &c : find_contacts(state, std::vector<double>(n, 0.)))
      {
        Eigen::Matrix<double, 6, 2> b;
        const double                nx = c.normal.x(), ny = c.normal.y();
        b.col(0) << nx, ny, 0, -nx, -ny, 0;
        b.col(1) << -ny, nx, -1, ny, -nx, -1;
        for (int row = 0; row < 6; ++row) // divided by the square roots of the masses
          {
            const int body = row < 3 ? c.i : c.j;
            b.row(row) *= body < n ? std::sqrt(g.inverse_mass(body) * (row % 3 == 2 ? 2 : 1)) : 0.;
          }
        const Eigen::Matrix<double, 6, 6> k       = b * Eigen::Vector2d(kn, kt).asDiagonal() * b.transpose();
        const int                         body[2] = {c.i, std::min(c.j, n - 1)};
        for (int p = 0; p < 2; ++p)
          for (int q = 0; q < 2; ++q)
            K.block<3, 3>(3 * body[p], 3 * body[q]) += k.block<3, 3>(3 * p, 3 * q);
      }
    return std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff());
  }

  // Largest kinetic energy within n_steps after a small push, relative to the push; infinity after a blow-up.
  double growth(State state, const double step, const double stiffness, const double friction, const int n_steps)
  {
    std::mt19937                           random(1);
    std::uniform_real_distribution<double> push(-1e-7 * std::sqrt(stiffness), 1e-7 * std::sqrt(stiffness));
    for (std::size_t i = 0; i < state.grains.size(); ++i)
      if (!state.grains.fixed[i])
        {
          state.grains.velocity[i] = {push(random), push(random)};
          state.grains.spin[i]     = push(random);
        }
    Penalty penalty(step, stiffness);
    penalty.setting.law.friction = penalty.setting.law.platen_friction = friction;
    const double start                                                 = kinetic_energy(state.grains);
    double       largest                                               = 0;
    for (int k = 0; k < n_steps; ++k)
      {
        const StepResult result = penalty.advance(state);
        if (result.solve.status != SolveStatus::converged)
          return result.solve.residual;
        largest = std::max(largest, result.energies.kinetic / start);
      }
    return largest;
  }

  // Leapfrog is stable for h < 2/omega_max. Below, with omega h = 1.9, the kinetic energy of a mode is at most 1/(1 - (omega
  // h/2)^2) = 10 times its start. Above, at 2.1, it grows by 1.88^2 = 3.5 per step.
  TEST(Penalty, HexagonalPatchBlowsUpAtTheStepOfItsHighestFrequency)
  {
    const double stiffness = 1e3, mass = M_PI / 4;
    const State  state = hexagonal_patch(10, 1e-3);
    for (const bool sticking : {false, true})
      {
        const double friction = sticking ? 100 : 0;
        const double critical = 2 / highest_frequency(state, stiffness, sticking ? kt_over_kn * stiffness : 0.);
        EXPECT_LT(growth(state, 0.95 * critical, stiffness, friction, 4000), 20) << "friction " << friction;
        EXPECT_GT(growth(state, 1.05 * critical, stiffness, friction, 40), 1e6) << "friction " << friction;
        // Infinite lattice, frictionless: two of three bond directions in antiphase give omega^2 = 4 kn/m x 3/2.
        if (!sticking)
          {
            EXPECT_NEAR(critical / std::sqrt(mass / stiffness), 2 / std::sqrt(6.), 0.02);
          }
      }
  }

  TEST(Penalty, BlowUpIsReportedAndLeavesTheStateAlone)
  {
    const double stiffness    = 1e3;
    State        state        = hexagonal_patch(6, 0.02);
    state.grains.velocity[14] = {0.1, 0.03};
    Penalty penalty(3 * penalty_step(state.grains, stiffness, 1.), stiffness);
    for (int k = 0; k < 1000; ++k)
      {
        const State      before = state;
        const StepResult result = penalty.advance(state);
        if (result.solve.status == SolveStatus::converged)
          continue;
        EXPECT_EQ(result.solve.status, SolveStatus::blown_up); // without sweeps
        EXPECT_TRUE(std::isinf(result.solve.residual));
        EXPECT_EQ(state.grains.position, before.grains.position);
        EXPECT_EQ(state.grains.velocity, before.grains.velocity);
        EXPECT_EQ(state.time, before.time);
        for (const Eigen::Vector2d &x : state.grains.position)
          EXPECT_TRUE(x.allFinite());
        return;
      }
    FAIL() << "a step of three times sqrt(m/kn) must blow up";
  }

  // VALIDATION with dense samples of 1000 discs: 1.027 sqrt(m_min/kn) frictionless, 0.769 sticking. With 200 discs the few
  // neighbours of the smallest disc decide and single boxes scatter by 5 %. So means over three seeds must agree within 5 %.
  TEST(Penalty, PolydisperseSampleBlowsUpAtTheStepOfItsHighestFrequency)
  {
    const double stiffness = 1e3;
    for (const bool sticking : {false, true})
      {
        const double friction = sticking ? 100 : 0;
        double       mean     = 0;
        for (const unsigned seed : {1, 2, 3})
          {
            const State  state    = relaxed_polydisperse_box(200, 0.85, seed);
            const double critical = 2 / highest_frequency(state, stiffness, sticking ? kt_over_kn * stiffness : 0.);
            EXPECT_LT(growth(state, 0.95 * critical, stiffness, friction, 2000), 20) << "friction " << friction;
            EXPECT_GT(growth(state, 1.05 * critical, stiffness, friction, 60), 1e6) << "friction " << friction;
            mean += critical / penalty_step(state.grains, stiffness, 1.) / 3;
          }
        EXPECT_NEAR(mean, sticking ? 0.769 : 1.027, 0.05 * mean) << "friction " << friction;
      }
  }
} // namespace
