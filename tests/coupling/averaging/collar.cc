// diptych: tests of the nodal identity at every node for samples that extend beyond the mesh
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/averaging/collar.h"
#include "coupling/averaging/periodic.h"
#include "discrete/panel/make_snapshot.h"
#include "discrete/samples/sample_preparation.h"
#include "tests/coupling/synthetic_samples.h"

namespace
{
  using namespace diptych;
  using namespace diptych::coupling;

  discrete::Snapshot snapshot_of(const synthetic::Network &network)
  {
    discrete::Snapshot s;
    s.position      = network.position;
    s.radius        = network.radius;
    s.window_forces = network.contacts;
    s.mean_spin_term.assign(network.position.size(), 0.01);
    return s;
  }

  // A wave as large as a quarter of a cell of 1.7, which bends edges.
  Eigen::Vector2d wave(const Eigen::Vector2d &x)
  {
    return {0.4 * std::sin(0.9 * x.y() + 0.3), 0.4 * std::sin(0.8 * x.x() - 0.2)};
  }

  bool left_of_a_diagonal(const Eigen::Vector2d &x)
  {
    return x.x() + 0.4 * x.y() < 14;
  }

  // The forces are random, so nothing is in equilibrium. Round-off: sums of some 10 terms of 1e-16 relative.
  TEST(Collar, NodalIdentityHoldsAtEveryNodeIfTheSampleExtendsBeyondTheMesh)
  {
    const auto network = synthetic::random_network({0, 0}, {20, 30}, 800, 4);
    const auto refined = synthetic::refined_mesh({3, 2}, {17, 21}, {{8, 11}}, left_of_a_diagonal, wave);
    for (const QuadMesh &mesh : {synthetic::box_mesh({3, 2}, {17, 21}, 9, 9, 0.3), refined})
      {
        const MappedGrains mapped = map_grains(mesh, snapshot_of(network));
        EXPECT_TRUE(mapped.has_collar);
        EXPECT_LT(mapped.nodal_residual, 1e-13);
        EXPECT_GT(mapped.moment.outside_share, 0.1);
        EXPECT_LT(mapped.moment.outside_share, 0.7);
        EXPECT_LT(synthetic::loss(mapped.moment), 1e-12);
      }
  }

  // The weights of outside segments must equal those that map_segments() finds without a collar.
  TEST(Collar, OutsideShareDoesNotDependOnTheCollar)
  {
    const auto     network = synthetic::random_network({0, 0}, {20, 30}, 800, 5);
    const QuadMesh mesh    = synthetic::box_mesh({3, 2}, {17, 21}, 9, 9, 0.3);
    const double   alone   = map_segments(mesh, TriangleSearch(mesh), network.position, network.contacts).outside_share;
    EXPECT_NEAR(map_grains(mesh, snapshot_of(network)).moment.outside_share, alone, 1e-12);
  }

  // A branch from (1, 1) to a platen's contact point at (1, -1), with the mesh ending at y = 0. The outer half belongs to the
  // cell above it, the first of three cells 2 wide: 5 x 2.
  TEST(Collar, PieceOutsideBelongsToTheBoundaryCell)
  {
    const QuadMesh     mesh = synthetic::box_mesh({0, 0}, {6, 2}, 3, 1);
    synthetic::Network network;
    network.position          = {{1, 1}};
    network.radius            = {2};
    network.contacts          = {{0, 1, {1, -1}, {0, 1}, {0, 5}}};
    discrete::Snapshot grains = snapshot_of(network);
    grains.mean_spin_term     = {0};
    const MappedGrains mapped = map_grains(mesh, grains);
    EXPECT_NEAR(mapped.moment.outside_share, 0.5, 1e-12);
    EXPECT_NEAR((mapped.moment.triangle_moment[0] + mapped.moment.triangle_moment[1])(1, 1), 10, 1e-12);
    EXPECT_LT(mapped.nodal_residual, 1e-14);
  }

  // An L of two arms 1 wide and 12 long. Its middle (3.0, 3.0) lies outside it; the square in its corner sees everything.
  TEST(Collar, FindsTheCornerOfAnLShapedMesh)
  {
    QuadMesh mesh = regular_grid({0, 0}, {12, 12}, 1);
    mesh.cell.erase(std::remove_if(mesh.cell.begin(), mesh.cell.end(),
                                   [&](const auto &c) { return mesh.node[c[0]].cwiseMin(mesh.node[c[2]]).minCoeff() > 0.5; }),
                    mesh.cell.end());
    triangulate(mesh);
    ASSERT_EQ(mesh.cell.size(), 23u);
    const auto         network = synthetic::random_network({-1, -1}, {13, 13}, 500, 6);
    const MappedGrains mapped  = map_grains(mesh, snapshot_of(network));
    EXPECT_TRUE(mapped.has_collar);
    EXPECT_LT(mapped.nodal_residual, 1e-12);
    EXPECT_GT(mapped.moment.outside_share, 0.5);
  }

  // A U is not star-shaped, because no place in it sees both arms. The totals must still be exact.
  TEST(Collar, MeshThatIsNotStarShapedHasTotalsButNoCollar)
  {
    QuadMesh mesh = regular_grid({0, 0}, {9, 9}, 1);
    mesh.cell.erase(std::remove_if(mesh.cell.begin(), mesh.cell.end(),
                                   [&](const auto &c) {
                                     const Eigen::Vector2d &x = mesh.node[c[0]];
                                     return x.x() > 0.5 && x.x() < 7.5 && x.y() > 0.5;
                                   }),
                    mesh.cell.end());
    triangulate(mesh);
    const auto         network = synthetic::random_network({0, 0}, {9, 9}, 300, 7);
    const MappedGrains mapped  = map_grains(mesh, snapshot_of(network));
    EXPECT_FALSE(mapped.has_collar);
    EXPECT_TRUE(std::isnan(mapped.nodal_residual));
    EXPECT_GT(mapped.moment.outside_share, 0.3);
    EXPECT_LT(synthetic::loss(mapped.moment), 1e-12);
  }

  // A network over one period, with every grain shifted by whole periods and every contact across the edge by its own shift.
  discrete::Snapshot periodic_network(const double period)
  {
    const auto         network = synthetic::random_network({0, 0}, {period, 30}, 800, 8);
    discrete::Snapshot s       = snapshot_of(network);
    s.cell_width               = period;
    const auto images          = [](const int i) { return i % 7 - 3; };
    const int  n               = int(s.position.size());
    for (int i = 0; i < n; ++i)
      s.position[i].x() += images(i) * period;
    for (auto &c : s.window_forces)
      {
        c.point.x() += images(c.i) * period;
        if (c.j < n)
          {
            const double apart = s.position[c.i].x() - s.position[c.j].x();
            c.shift            = std::round(apart / period) * period;
            const Eigen::Vector2d image(s.position[c.j].x() + c.shift, s.position[c.j].y());
            c.point = 0.5 * (s.position[c.i] + image);
          }
      }
    return s;
  }

  // The sides are straight or curved and one period apart. The mesh may be whole periods away. Grains lie above and below the
  // mesh, and one side of the edge has hanging nodes.
  TEST(Collar, NodalIdentityHoldsAcrossTheEdgeOfAPeriodicSample)
  {
    const double period  = 20;
    const auto   leaning = [](const Eigen::Vector2d &x) { return Eigen::Vector2d(std::sin(0.2 * x.y()) + 0.1 * x.y(), 0.); };
    const auto   inner   = [](const Eigen::Vector2d &x) { return x.x() > 5 && x.x() < 12 && x.y() > 9; };
    for (const QuadMesh &mesh : {regular_grid({0, 5}, {period, 21}, 1.7), regular_grid({-33, 4}, {period - 33, 22}, 2.3),
                                 synthetic::refined_mesh({0, 4}, {period, 20}, {{11, 9}}, inner, leaning)})
      {
        const MappedGrains mapped = map_grains(mesh, periodic_network(period));
        EXPECT_TRUE(mapped.has_collar);
        EXPECT_LT(mapped.nodal_residual, 1e-13);
        EXPECT_GT(mapped.moment.outside_share, 0.02);
        EXPECT_LT(synthetic::loss(mapped.moment), 1e-12);
      }
  }

  TEST(Collar, PeriodicMeshOfAnotherWidthHasTotalsButNoCollar)
  {
    const MappedGrains mapped = map_grains(regular_grid({0, 0}, {19.5, 30}, 1.5), periodic_network(20));
    EXPECT_FALSE(mapped.has_collar);
    EXPECT_TRUE(std::isnan(mapped.nodal_residual));
    EXPECT_LT(synthetic::loss(mapped.moment), 1e-12);
  }

  // A real sample after a few steps of shear, with the velocities before the last step.
  struct Sheared
  {
    discrete::Snapshot           grains;
    std::vector<Eigen::Vector2d> acceleration; // in the last step
  };

  Sheared sheared(const discrete::Lateral lateral, const double gravity)
  {
    discrete::SampleOptions options;
    options.grains = 250;
    discrete::PreparationSetting preparation;
    discrete::LateralOptions     sides;
    sides.lateral                  = lateral;
    sides.side_motion              = discrete::SideMotion::velocity;
    preparation.lateral            = discrete::lateral_condition(sides);
    preparation.gravity            = {0.3 * gravity, -gravity};
    auto [state, first, h, report] = discrete::prepare_sample(options, preparation, [](int, int) { return true; });

    discrete::StepSetting setting;
    setting.step               = 0.1;
    setting.lateral            = preparation.lateral;
    setting.stepping.gravity_x = preparation.gravity.x();
    setting.stepping.gravity_y = preparation.gravity.y();
    setting.solver.tolerance =
      1e-3; // the identity needs no accurate solution, because the impulses determine the velocities in any case
    const auto            reference    = discrete::make_reference(state, 1, 0.);
    const bool            compressible = lateral != discrete::Lateral::periodic; // rigid grains of a constant width are not
    const Eigen::Vector2d velocity(0.02, compressible ? -0.02 : 0.01);
    state.walls[1].velocity = velocity;
    for (std::size_t i = 0; i < state.grains.size(); ++i)
      state.grains.velocity[i] = velocity * state.grains.position[i].y() / state.walls[1].point.y();

    Sheared result;
    for (int k = 0; k < 5; ++k)
      {
        const std::vector<Eigen::Vector2d> before = state.grains.velocity;
        const discrete::StepResult         step   = discrete::advance(state, setting);
        result.grains                             = discrete::make_snapshot(state, step, {}, reference, setting);
        EXPECT_EQ(step.solve.status, discrete::SolveStatus::converged);
        result.acceleration.clear();
        for (std::size_t i = 0; i < before.size(); ++i)
          result.acceleration.push_back((state.grains.velocity[i] - before[i]) / setting.step);
      }
    return result;
  }

  // The box of the grains, reduced by `inset` at the platens and at any sides.
  std::pair<Eigen::Vector2d, Eigen::Vector2d> box(const discrete::Snapshot &s, const double inset)
  {
    Eigen::Vector2d lower = s.position[0], upper = lower;
    for (const Eigen::Vector2d &x : s.position)
      lower = lower.cwiseMin(x), upper = upper.cwiseMax(x);
    if (s.cell_width > 0)
      return {{0, s.lower_y + inset}, {s.cell_width, s.upper_y - inset}};
    return {{lower.x() + inset, s.lower_y + inset}, {upper.x() - inset, s.upper_y - inset}};
  }

  double largest_contact_force(const discrete::Snapshot &s)
  {
    double largest = 0;
    for (const auto &c : s.contacts)
      largest = std::max(largest, c.force.norm());
    return largest;
  }

  // The step's velocities are v + h M^-1 (F + sum of contact forces). Therefore m a - F equals the contact forces to round-off,
  // and both sides differ by sums of 1e-16 x some 10 forces. Platens and contacts beyond the mesh are included.
  void expect_momentum_balance(const Sheared &sample, const bool inset)
  {
    const auto [lower, upper] = box(sample.grains, inset ? 1.3 : -0.5);
    const auto inner          = [](const Eigen::Vector2d &x) { return x.x() > 4 && x.x() < 9 && x.y() > 4; };
    const auto bent           = [](const Eigen::Vector2d &x) { return Eigen::Vector2d(0.3 * std::sin(0.7 * x.y()), 0); };
    const auto straight       = [](const Eigen::Vector2d &) { return Eigen::Vector2d(0, 0); };
    for (const QuadMesh &mesh : {regular_grid(lower, upper, 1.72), synthetic::refined_mesh(lower, upper, {{8, 9}}, inner, bent),
                                 synthetic::refined_mesh(lower, upper, {{8, 9}}, inner, straight)})
      {
        const MappedGrains mapped = map_grains(mesh, sample.grains);
        EXPECT_LT(mapped.nodal_residual, 1e-12);
        EXPECT_LT(momentum_residual(mesh, sample.grains, sample.acceleration), 1e-12);
        EXPECT_GE(mapped.moment.outside_share, inset ? 0.02 : 0);
      }
  }

  TEST(Collar, MomentumBalanceHoldsAtEveryNodeWithTheContainingAction)
  {
    const Sheared sample = sheared(discrete::Lateral::end_grains, 0);
    double        action = 0;
    for (const auto &f : sample.grains.applied_force)
      action = std::max(action, std::abs(f.x()));
    EXPECT_GT(action, 0.1); // a strip w = 3 at P = 1 over five grains gives 0.6 on average
    expect_momentum_balance(sample, false);
    expect_momentum_balance(sample, true);
  }

  TEST(Collar, MomentumBalanceHoldsAtEveryNodeWithGravity)
  {
    expect_momentum_balance(sheared(discrete::Lateral::end_grains, 0.1), true);
  }

  TEST(Collar, MomentumBalanceHoldsAtEveryNodeOfAPeriodicSample)
  {
    const Sheared sample = sheared(discrete::Lateral::periodic, 0.05);
    ASSERT_GT(sample.grains.cell_width, 0);
    EXPECT_GT(largest_contact_force(sample.grains), 0.5);
    expect_momentum_balance(sample, false);
    expect_momentum_balance(sample, true);
  }

  // An end grain carries 0.6 on average (w P over five grains). The nearest node has at least a third of that, and other grains
  // on the same side add to it.
  TEST(Collar, MomentumBalanceFailsWithoutAnAppliedForce)
  {
    Sheared sample            = sheared(discrete::Lateral::end_grains, 0);
    const auto [lower, upper] = box(sample.grains, 1);
    for (auto &f : sample.grains.applied_force)
      f.setZero();
    EXPECT_GT(momentum_residual(regular_grid(lower, upper, 1.72), sample.grains, sample.acceleration),
              0.2 / largest_contact_force(sample.grains));
  }
} // namespace
