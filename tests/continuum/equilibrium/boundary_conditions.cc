// diptych: forces and motion of platens and sides
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <tuple>

#include "continuum/equilibrium/boundary_value_problem.h"
#include "continuum/equilibrium/loads.h"
#include "tests/continuum/continuum_scenes.h"

namespace
{
  using namespace diptych::continuum::tests;

  // Nodes of a snapshot whose initial position satisfies a condition, sorted by height, then horizontal position.
  template <class Condition> std::vector<std::size_t> nodes_where(const Snapshot &s, const Condition &condition)
  {
    std::vector<std::size_t> nodes;
    const auto               initial = [&](const std::size_t k) { return Eigen::Vector2d(s.position[k] - s.displacement[k]); };
    for (std::size_t k = 0; k < s.position.size(); ++k)
      if (condition(initial(k)))
        nodes.push_back(k);
    std::sort(nodes.begin(), nodes.end(), [&](const std::size_t a, const std::size_t b) {
      return std::pair(initial(a).y(), initial(a).x()) < std::pair(initial(b).y(), initial(b).x());
    });
    return nodes;
  }
  std::vector<std::size_t> nodes_at_x(const Snapshot &s, const double x)
  {
    return nodes_where(s, [x](const Eigen::Vector2d &p) { return std::abs(p.x() - x) < 1e-9; });
  }

  // Largest difference of the horizontal displacements of some nodes.
  double spread(const Snapshot &s, const std::vector<std::size_t> &nodes)
  {
    const auto [least, largest] = std::minmax_element(nodes.begin(), nodes.end(), [&](const std::size_t a, const std::size_t b) {
      return s.displacement[a].x() < s.displacement[b].x();
    });
    return s.displacement[*largest].x() - s.displacement[*least].x();
  }

  // The weak spot makes the fields inhomogeneous.
  Options with_weak_spot(Options options)
  {
    options.material.softening_strain = 0.05;
    options.weak_spot_strain          = 0.05;
    options.weak_spot_x = options.weak_spot_y = 0.3;
    return options;
  }

  // int p dy along both sides: pressure x height on each side, inwards, for any shape; no vertical force.
  TEST(BoundaryConditions, SidePressureActsHorizontallyPerUnitOfHeight)
  {
    const QuadMesh mesh_file = outline_mesh(wavy_outline(14, 20, 31, 0.5), 2.);
    for (const ElementKind kind : {ElementKind::q2, ElementKind::q1_mean_dilation})
      {
        const Discretisation mesh(mesh_file, kind, MPI_COMM_WORLD);
        auto                 position = positions(mesh, std::vector<double>(mesh.relevant.n_elements(), 0.));
        for (auto &x : position)
          x += Eigen::Vector2d(0.3 * std::sin(x.y()), 0.02 * x.y() * (20 - x.y())); // bulges; the ends stay in place
        std::vector<double> force(mesh.relevant.n_elements(), 0.);
        add_side_pressure(mesh, position, 3., force);
        double left = 0, right = 0, vertical = 0;
        for (const Node &node : mesh.nodes)
          {
            (node.initial.x() < 7 ? left : right) += force[node.local[0]];
            vertical += std::abs(force[node.local[1]]);
          }
        EXPECT_NEAR(left, 3 * 20, 1e-10);
        EXPECT_NEAR(right, -3 * 20, 1e-10);
        EXPECT_EQ(vertical, 0);
      }
  }

  // A rectangle under its own isotropic pressure is at rest under all boundary conditions.
  TEST(BoundaryConditions, ARectangleUnderItsPressureIsAtRest)
  {
    const QuadMesh mesh    = rectangle(12, 16, 2.);
    Loading        loading = straight_loading(2, {0, -16}, {1}), held_up = loading;
    held_up.platens[1][1] = force(-2 * 12);
    for (const auto &[name, lateral, platens] : std::vector<std::tuple<std::string, LateralCondition, Platens>>{
           {"pressure", SidePressure(), Platens::rough},
           {"pressure", SidePressure(), Platens::smooth},
           {"rigid walls at rest", RigidSides{[](double) { return 0.; }}, Platens::rough},
           {"rigid wall, smooth", RigidSides(), Platens::smooth},

           {"fixed width", PeriodicSides{0.}, Platens::rough},
           {"fixed width", PeriodicSides{0.}, Platens::smooth},
           {"free width", PeriodicSides{std::nullopt}, Platens::smooth}})
      for (Loading one : {loading, held_up})
        for (const LawKind law : {LawKind::mohr_coulomb, LawKind::cosserat_mohr_coulomb})
          {
            one.lateral     = lateral;
            Options options = with({}, platens, Kinematics::updated);
            options.law     = law;
            BoundaryValueProblem problem(mesh, Units(), one, options);
            problem.begin_step(0);
            const Imbalance imbalance = problem.evaluate(problem.zero_vector());
            EXPECT_LT(imbalance.residual, 1e-11) << name << ", " << name_of(law);
            EXPECT_GT(imbalance.scale, 1);
          }
  }

  // The corner nodes of a platen belong to it, including the wall's part of the pressure on them. Mean s_xx is the pressure
  // also between rough platens.
  TEST(BoundaryConditions, RigidWallBetweenRoughPlatensCarriesThePressure)
  {
    const Loading loading = with_sides(straight_loading(1, {0, -16}, {0}), RigidSides());
    const Course  c       = finished(rectangle(12, 16, 2.), loading, with(elastic(), Platens::rough, Kinematics::small_strain));
    EXPECT_NEAR(c.end().mean_stress(0, 0), 1, 1e-6);
  }

  // The pressure acts horizontally and equally on both sides, also on wavy ones. The platen forces therefore balance each
  // other.
  TEST(BoundaryConditions, PlatensBalanceEachOther)
  {
    const QuadMesh mesh = outline_mesh(wavy_outline(14, 20, 11, 0.15), 2.);
    for (const Kinematics geometry : {Kinematics::updated, Kinematics::small_strain})
      {
        const Course c     = finished(mesh, straight_loading(1, {20, -20}, {0.02}), with({}, Platens::rough, geometry));
        const double scale = c.end().upper_platen_force.norm();
        EXPECT_GT(scale, 14);
        for (const HistoryRow &row : c.rows)
          EXPECT_NEAR((row.lower_platen_force + row.upper_platen_force).norm() / scale, 0, 1e-4) << row.axial_strain;
      }
  }

  // Weight 0.1 per area, 4 x 6: the lower platen carries 2.4 more than the upper one, before and during compression.
  TEST(BoundaryConditions, LowerPlatenCarriesTheWeight)
  {
    const QuadMesh mesh    = rectangle(4, 6, 1.);
    Loading        loading = straight_loading(1, {0, -6}, {0, 0.005});
    loading.body_force     = {0, -0.1};
    for (const Platens platens : {Platens::rough, Platens::smooth})
      {
        const Course c = finished(mesh, loading, with(elastic(), platens, Kinematics::small_strain));
        for (const Snapshot &s : c.snapshots)
          {
            EXPECT_NEAR(s.lower_platen_force.y() + s.upper_platen_force.y(), 2.4, 1e-4);
            EXPECT_GT(-s.upper_platen_force.y(), 2.4);
          }
      }
  }

  // Free sides, elastic, smooth platens: the initial pressure relaxes to uniaxial compression without lateral stress.
  TEST(BoundaryConditions, FreeSidesCarryNothing)
  {
    const Loading loading = with_sides(straight_loading(1, {0, -6}, {1e-3}), FreeSides());
    const Course  c       = finished(rectangle(4, 6, 1.), loading, with(elastic(), Platens::smooth, Kinematics::small_strain));
    EXPECT_NEAR(c.end().mean_stress(0, 0), 0, 1e-4);
    // Relaxing s_xx from 1 to 0 at fixed height reduces s_yy by nu/(1 - nu) = 0.25. Then E/(1 - nu^2) x 1e-3 = 0.520833 is
    // added.
    EXPECT_NEAR(c.end().mean_stress(1, 1), 0.75 + 0.520833, 1e-4);
    // The trace of the strain: eyy = 1e-3 and exx = (1 - nu^2)/E (-1 - 0.25 (0.520833 - 0.25)) = -2.05e-3.
    EXPECT_NEAR(c.end().volumetric_strain, 1e-3 - 2.05e-3, 1e-7);
  }

  // A rigid smooth wall under pressure moves as one. The mean of s_xx balances it, also if the field is inhomogeneous.
  TEST(BoundaryConditions, RigidWallUnderPressure)
  {
    const QuadMesh mesh    = rectangle(12, 16, 2.);
    const Loading  loading = with_sides(straight_loading(1, {0, -16}, {0.01}), RigidSides());
    const Course   c       = finished(mesh, loading, with_weak_spot(with({}, Platens::smooth, Kinematics::small_strain)));
    EXPECT_NEAR(c.end().mean_stress(0, 0), 1, 1e-4);
    const Snapshot &s    = c.snapshots.back();
    const auto      wall = nodes_at_x(s, 12), other = nodes_at_x(s, 0), inside = nodes_at_x(s, 6);
    ASSERT_EQ(wall.size(), 17u);
    EXPECT_LT(spread(s, wall), 1e-9);
    EXPECT_GT(s.displacement[wall[0]].x(), 0.01);
    for (const auto k : other)
      EXPECT_NEAR(s.displacement[k].x(), 0, 1e-12);
    EXPECT_GT(spread(s, inside), 1e-3) << "the field is inhomogeneous";
  }

  // On the moved shape the mean of s_xx also balances the pressure P.
  TEST(BoundaryConditions, RigidWallCarriesThePressureOnTheMovedShape)
  {
    const QuadMesh mesh    = rectangle(12, 16, 4.);
    const Loading  loading = with_sides(straight_loading(1, {0, -16}, {0.05}), RigidSides());
    const Course   c = finished(mesh, loading, with_steps(with_weak_spot(with({}, Platens::smooth, Kinematics::updated)), 1e-3));
    EXPECT_NEAR(c.end().mean_stress(0, 0), 1, 2e-3);
    const HistoryRow &row = c.end();
    EXPECT_NEAR(row.width * row.core_stress(1, 1) / row.lower_platen_force.y(), 1, 2e-3)
      << "every cut carries the platens' force";
    EXPECT_NEAR(row.platen_sxx, 0, 1e-6) << "smooth platens";
  }

  // Pressure on the sides causes P of the mean sxx, rough platens cause the rest. The nodes carry the platens' forces.
  TEST(BoundaryConditions, PlatensCauseTheStressBeyondThePressure)
  {
    for (const Kinematics kinematics : {Kinematics::small_strain, Kinematics::updated})
      {
        const Loading loading = straight_loading(1, {0, -16}, {0.02});
        const Course  c       = finished(rectangle(12, 16, 2.), loading, with_steps(with({}, Platens::rough, kinematics), 1e-3));
        EXPECT_GT(c.end().platen_sxx, 0.1);
        EXPECT_NEAR(c.end().mean_stress(0, 0) - c.end().platen_sxx, 1, 1e-3);
        Eigen::Vector2d lower(0, 0);
        for (const Eigen::Vector2d &force : c.snapshots.back().platen_force)
          lower += force.y() > 0 ? force : Eigen::Vector2d(0, 0);
        EXPECT_NEAR((lower - c.end().lower_platen_force).norm(), 0, 1e-6);
      }
  }

  // Walls moved apart: elastic, e_y = eps compressive, e_x = -w eps/W. With M = E (1 - nu)/((1 + nu)(1 - 2 nu)) = 555.556 and
  // lambda = M nu/(1 - nu) = 138.889: d s_xx = lambda e_y + M e_x, d s_yy = M e_y + lambda e_x.
  TEST(BoundaryConditions, RigidWallsDrivenApart)
  {
    Loading loading = straight_loading(1, {0, -6}, {1e-4});
    loading.lateral = RigidSides{[](const double progress) { return 2 * progress; }};
    const Course c  = finished(rectangle(4, 6, 2.), loading, with(elastic(), Platens::smooth, Kinematics::small_strain));
    EXPECT_NEAR((c.end().mean_stress(0, 0) - 1) / 1e-4, 138.889 - 0.5 * 555.556, 0.01);
    EXPECT_NEAR((c.end().mean_stress(1, 1) - 1) / 1e-4, 555.556 - 0.5 * 138.889, 0.01);
  }

  // Periodic sides of fixed width, elastic: no lateral strain, d s_xx = K0 d s_yy, K0 = nu/(1 - nu) = 0.25, d s_yy = 555.556
  // eps.
  TEST(BoundaryConditions, PeriodicSidesOfFixedWidthGiveK0)
  {
    const QuadMesh mesh    = rectangle(4, 6, 2.);
    const Loading  loading = with_sides(straight_loading(1, {0, -6}, {1e-4}), PeriodicSides{0.});
    for (const Platens platens : {Platens::rough, Platens::smooth})
      {
        const Course c = finished(mesh, loading, with(elastic(), platens, Kinematics::small_strain));
        EXPECT_NEAR((c.end().mean_stress(1, 1) - 1) / 1e-4, 555.556, 0.01);
        EXPECT_NEAR((c.end().mean_stress(0, 0) - 1) / 1e-4, 138.889, 0.01);
      }
  }

  // Periodic sides of free width: all pairs have the same distance. Mean s_xx is the pressure.
  TEST(BoundaryConditions, PeriodicSidesOfFreeWidthCarryThePressure)
  {
    const QuadMesh  mesh    = rectangle(12, 16, 2.);
    const Loading   loading = with_sides(straight_loading(1, {0, -16}, {0, 0.01}), PeriodicSides{std::nullopt});
    const Course    c       = finished(mesh, loading, with_weak_spot(with({}, Platens::smooth, Kinematics::small_strain)));
    const Snapshot &s       = c.snapshots.back();
    const auto      left = nodes_at_x(s, 0), right = nodes_at_x(s, 12);
    ASSERT_EQ(left.size(), 17u);
    ASSERT_EQ(right.size(), 17u);
    const double widening = (s.displacement[right[0]] - s.displacement[left[0]]).x();
    EXPECT_GT(widening, 0.01);
    for (std::size_t k = 0; k < left.size(); ++k)
      {
        const Eigen::Vector2d apart = s.displacement[right[k]] - s.displacement[left[k]];
        EXPECT_NEAR(apart.x(), widening, 1e-9);
        EXPECT_NEAR(apart.y(), 0, 1e-9);
      }
    EXPECT_GT(spread(s, left), 1e-3) << "a side need not stay straight";
    EXPECT_NEAR(c.snapshots[0].mean_stress(0, 0), 1, 1e-4);
    EXPECT_NEAR(c.end().mean_stress(0, 0), 1, 1e-4);
    for (const CellState &cell : c.snapshots[0].cell_state)
      EXPECT_NEAR(cell.stress(0, 0), 1, 1e-4) << "nothing disturbs the state at rest";
  }

  // Material that leaves on one side returns on the other, with the same rotation.
  TEST(BoundaryConditions, PeriodicSidesRotateAlike)
  {
    const QuadMesh mesh    = rectangle(12, 12, 2.);
    Loading        loading = with_sides(straight_loading(1, {12, 0}, {0.02}), PeriodicSides{0.});
    loading.platens[1][1]  = force(-12);
    Options options        = with_weak_spot({});
    options.weak_spot_x    = 0.9;
    const Course    c      = finished(mesh, loading, options);
    const Snapshot &s      = c.snapshots.back();
    ASSERT_EQ(s.rotation.size(), s.position.size());
    const auto left = nodes_at_x(s, 0), right = nodes_at_x(s, 12);
    double     largest = 0;
    for (std::size_t k = 0; k < left.size(); ++k)
      {
        EXPECT_NEAR(s.rotation[right[k]], s.rotation[left[k]], 1e-9) << "at height " << s.position[left[k]].y();
        largest = std::max(largest, std::abs(s.rotation[left[k]]));
      }
    EXPECT_GT(largest, 1e-3);
  }

  // Plane shear: the upper platen is driven sideways and moves freely in the vertical under its force. Mean s_yy = force/width
  // throughout, while the sample dilates. Once the stresses have settled, no strain remains along the flow. Then psi = 10 lifts
  // the platen by tan 10 per shear.
  TEST(BoundaryConditions, PlatenUnderAForceKeepsTheNormalStress)
  {
    const QuadMesh mesh    = rectangle(8, 8, 2.);
    Loading        loading = with_sides(straight_loading(1, {8, 0}, {0.08, 0.1}), PeriodicSides{0.});
    loading.platens[1][1]  = force(-3 * 8);
    loading.pressure       = 3;
    for (const LawKind law : {LawKind::mohr_coulomb, LawKind::cosserat_mohr_coulomb})
      {
        const Options options = with(perfectly_plastic(law, 30, 10, 0.01), Platens::rough, Kinematics::small_strain);
        const Course  c       = finished(mesh, loading, options);
        for (const HistoryRow &row : c.rows)
          {
            EXPECT_NEAR(row.mean_stress(1, 1), 3, 1e-4) << name_of(law);
            EXPECT_NEAR(row.upper_platen_force.y(), -24, 24e-4);
          }
        const auto height = [&](const Snapshot &s) {
          const auto upper = nodes_where(s, [](const Eigen::Vector2d &p) { return p.y() > 8 - 1e-9; });
          for (const auto k : upper)
            EXPECT_NEAR(s.displacement[k].y(), s.displacement[upper[0]].y(), 1e-9) << "the platen moves as one";
          return s.position[upper[0]].y();
        };
        const double rise = height(c.snapshots[1]) - height(c.snapshots[0]);
        EXPECT_NEAR(rise / (8 * 0.02), std::tan(10 * M_PI / 180), 0.002) << name_of(law);
      }
  }

  // Drives may be any function of the progress. An elastic platen that goes up and down again returns to its start.
  TEST(BoundaryConditions, PlatensFollowTheirFunctions)
  {
    const QuadMesh mesh         = rectangle(4, 6, 2.);
    Loading        loading      = straight_loading(1, {0, 0}, {0.5, 1});
    loading.platens[0][1].value = [](const double t) { return 1e-3 * std::sin(M_PI * t); };
    Options      options        = with_steps(with(elastic(), Platens::smooth, Kinematics::small_strain), 0.1);
    const Course c              = finished(mesh, loading, options);
    const auto   lower          = nodes_where(c.snapshots[0], [](const Eigen::Vector2d &p) { return p.y() < 1e-9; });
    for (const auto k : lower)
      EXPECT_NEAR(c.snapshots[0].displacement[k].y(), 1e-3, 1e-12);
    EXPECT_GT(c.snapshots[0].mean_stress(1, 1), 1.05);
    EXPECT_NEAR(c.snapshots[1].mean_stress(1, 1), 1, 1e-4);
  }

  // 45 degrees to 20 % strain on a coarse mesh: material squeezed out beside a platen rolls onto its plane and moves with it.
  TEST(SideContact, NothingIsExtrudedPastAPlaten)
  {
    const QuadMesh mesh                      = rectangle(60, 60, 4.);
    Options        options                   = Options();
    options.material.friction_angle_peak     = 30;
    options.material.friction_angle_residual = 22;
    options.material.softening_strain        = 0.1;
    const Course c                           = finished(mesh, straight_loading(1, {60, -60}, {0.12, 0.18, 0.2}), options);
    for (const Snapshot &s : c.snapshots)
      for (const Eigen::Vector2d &position : s.position)
        {
          EXPECT_LT(position.y(), 60 * (1 - s.axial_strain) + 0.02 * 60);
          EXPECT_GT(position.y(), -0.02 * 60);
        }
    const Snapshot &before = c.snapshots[1], &after = c.snapshots[2];
    int             n_captured = 0;
    for (std::size_t k = 0; k < after.position.size(); ++k)
      {
        const Eigen::Vector2d initial = after.position[k] - after.displacement[k];
        const bool            on_side = initial.x() < 1e-9 || initial.x() > 60 - 1e-9;
        if (!on_side || initial.y() < 1e-9 || initial.y() > 60 - 1e-9)
          continue;
        const Eigen::Vector2d step = after.displacement[k] - before.displacement[k];
        if (before.position[k].y() >= 60 * (1 - 0.18) - 1e-9)
          {
            ++n_captured;
            EXPECT_NEAR((step - Eigen::Vector2d(1.2, -1.2)).norm(), 0, 1e-9) << "moves with the upper platen";
          }
        else if (before.position[k].y() <= 1e-9)
          {
            ++n_captured;
            EXPECT_NEAR(step.norm(), 0, 1e-9) << "rests with the lower platen";
          }
      }
    EXPECT_GT(n_captured, 0);
    // Nodes in contact carry a part of the platen's force, so the platen forces still balance each other.
    EXPECT_NEAR((c.end().lower_platen_force + c.end().upper_platen_force).norm(), 0, 2e-3 * c.end().upper_platen_force.norm());
  }
} // namespace
