// diptych: runs on several processes, compared with the same run on one process
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/mpi.h>

#include "tests/continuum/continuum_scenes.h"

namespace
{
  using namespace diptych::continuum::tests;

  bool is_first()
  {
    return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  }

  constexpr int n_columns = 10, first_force = 3;
  using Row = std::array<double, n_columns>;

  Row numbers(const HistoryRow &row)
  {
    return {row.axial_strain,           row.stress_ratio,
            row.volumetric_strain,      row.upper_platen_force.x(),
            row.upper_platen_force.y(), row.lower_platen_force.x(),
            row.lower_platen_force.y(), row.dissipation,
            double(row.n_cells),        row.platen_sxx};
  }

  // Compares the run of all processes with the run of each of them without the others. `relative`: to the largest value of a
  // column.
  Course as_alone(const QuadMesh &mesh, const Loading &loading, const Options &options, const double relative, Wishes wishes = {})
  {
    const Course c      = course(mesh, loading, options, wishes);
    wishes.communicator = MPI_COMM_SELF;
    const Course alone  = course(mesh, loading, options, wishes);
    EXPECT_EQ(c.report.status, Status::finished) << c.report.message;
    EXPECT_GT(alone.end().stress_ratio, alone.rows.front().stress_ratio + 0.1) << "the sample was loaded";
    if (!is_first())
      {
        EXPECT_TRUE(c.rows.empty()) << "only the first process gets rows";
        return c;
      }
    EXPECT_GT(c.rows.size(), 3u);
    EXPECT_EQ(c.rows.size(), alone.rows.size());
    for (int k = 0; k < n_columns; ++k)
      {
        double     scale    = 1e-9;
        const bool is_force = k >= first_force && k < first_force + 4; // relative to the largest of their components
        for (const HistoryRow &row : alone.rows)
          for (int j = is_force ? first_force : k; j < (is_force ? first_force + 4 : k + 1); ++j)
            scale = std::max(scale, std::abs(numbers(row)[j]));
        for (std::size_t row = 0; row < std::min(c.rows.size(), alone.rows.size()); ++row)
          EXPECT_NEAR(numbers(c.rows[row])[k], numbers(alone.rows[row])[k], relative * scale)
            << "column " << k << ", row " << row;
      }
    // The snapshot is complete.
    const Snapshot &s    = c.snapshots.back();
    double          area = 0, middle = 0, lower = 0;
    for (std::size_t k = 0; k < s.weight.size(); ++k)
      {
        area += s.weight[k];
        middle += s.weight[k] * s.position[k].y() / s.area;
      }
    for (std::size_t k = 0; k < s.weight.size(); ++k)
      lower += s.position[k].y() < middle ? s.platen_force[k].y() : 0.;
    EXPECT_NEAR(lower, s.lower_platen_force.y(), 1e-6 * s.lower_platen_force.norm());
    EXPECT_NEAR(area, s.area, 1e-9 * s.area);
    EXPECT_EQ(int(s.cells.size()), c.end().n_cells);
    EXPECT_NEAR(1 - c.end().volumetric_strain, s.area / c.snapshots.front().area, 1e-9);
    return c;
  }

  Options fixed_steps(const LawKind law)
  {
    Options options   = with_steps({}, 1e-3);
    options.law       = law;
    options.tolerance = 1e-7;
    return options;
  }

  TEST(Parallel, FortyFiveDegreeShear)
  {
    const QuadMesh mesh = rectangle(14, 20, 2.);
    as_alone(mesh, straight_loading(1, {20, -20}, {0, 0.01}), fixed_steps(LawKind::cosserat_mohr_coulomb), 1e-4);
  }

  TEST(Parallel, MultigridSolver)
  {
    Options options       = fixed_steps(LawKind::mohr_coulomb);
    options.linear_solver = LinearChoice::amg;
    as_alone(rectangle(14, 20, 2.), straight_loading(1, {20, -20}, {0, 0.006}), options, 1e-4);
  }

  // Pairs of periodic nodes, and tied nodes of a platen, lie on different processes.
  TEST(Parallel, PlaneShearBetweenPeriodicSides)
  {
    Loading loading       = with_sides(straight_loading(1, {8, 0}, {0, 0.01}), PeriodicSides{0.});
    loading.platens[1][1] = force(-16);
    as_alone(rectangle(16, 8, 2.), loading, fixed_steps(LawKind::mohr_coulomb), 1e-4);
  }

  TEST(Parallel, RigidWallUnderPressure)
  {
    const QuadMesh mesh      = rectangle(8, 16, 2.);
    const Loading  loading   = with_sides(straight_loading(1, {0, -16}, {0, 0.01}), RigidSides());
    Options        options   = fixed_steps(LawKind::mohr_coulomb);
    options.platens          = Platens::smooth;
    options.element          = Displacement::q1_bbar;
    options.weak_spot_strain = 0.05;
    as_alone(mesh, loading, options, 1e-4);
  }

  TEST(Parallel, FrictionalPlatens)
  {
    Options options            = fixed_steps(LawKind::cosserat_mohr_coulomb);
    options.platens            = Platens::frictional;
    options.platen_friction    = 0.2;
    options.platen_slip_length = 5;
    as_alone(rectangle(14, 20, 2.), straight_loading(1, {0, -20}, {0, 0.01}), options, 1e-4);
  }

  // Stress given on the first process reaches the cells of the others. It grows from left to right and comes to rest.
  TEST(Parallel, MappedStress)
  {
    const QuadMesh mesh       = rectangle(12, 8, 2.);
    Options        options    = fixed_steps(LawKind::mohr_coulomb);
    options.initial_stress    = InitialStress::mapped;
    options.material.cohesion = 1;
    Wishes wishes;
    wishes.initial_stress = [](const Snapshot &s) {
      std::vector<Eigen::Matrix2d> stress;
      for (const auto &cell : s.cells)
        {
          stress.push_back(Eigen::Matrix2d::Identity());
          stress.back()(1, 1) = 1 + 0.05 * s.position[cell[8]].x();
        }
      return stress;
    };
    as_alone(mesh, straight_loading(1, {0, -8}, {0, 0.004}), options, 1e-4, wishes);
  }

  // Several processes resume a checkpoint of one process and reach the end of a run on one process.
  TEST(Parallel, AllProcessesResumeACheckpointOfOne)
  {
    const QuadMesh mesh    = rectangle(14, 20, 4.);
    const Loading  loading = straight_loading(1, {20, -20}, {0, 0.008});
    const Options  options = fixed_steps(LawKind::cosserat_mohr_coulomb);
    Wishes         wishes;
    wishes.communicator   = MPI_COMM_SELF;
    const Course whole    = course(mesh, loading, options, wishes);
    wishes.stop_requested = [](const std::size_t n_rows) { return n_rows >= 4; };
    const Course half     = course(mesh, loading, options, wishes);
    EXPECT_EQ(half.report.status, Status::stopped_by_user);
    const Course c = resumed(mesh, loading, options, half.checkpoint);
    EXPECT_EQ(c.report.status, Status::finished) << c.report.message;
    if (!is_first())
      return;
    EXPECT_EQ(c.rows.front().step, 4) << "the checkpoint was made after three steps";
    const double size = whole.end().upper_platen_force.norm();
    EXPECT_NEAR((c.end().upper_platen_force - whole.end().upper_platen_force).norm(), 0, 1e-4 * size);
  }

  // All processes write and resume a checkpoint. Factors of the last matrix are recomputed, all else is restored.
  TEST(ParallelChanges, AnInterruptedRunContinues)
  {
    const QuadMesh mesh    = rectangle(24, 24, 4.);
    const Loading  loading = straight_loading(1, {24, -24}, {0, 0.012});
    const Options  options = adaptive(fixed_steps(LawKind::cosserat_mohr_coulomb));
    const Course   whole   = course(mesh, loading, options);
    Wishes         wishes;
    wishes.stop_requested = [](const std::size_t n_rows) { return n_rows >= 9; };
    const Course half     = course(mesh, loading, options, wishes);
    const Course c        = resumed(mesh, loading, options, half.checkpoint);
    EXPECT_EQ(c.report.status, Status::finished) << c.report.message;
    if (!is_first())
      return;
    EXPECT_EQ(c.report.n_cells, whole.report.n_cells);
    EXPECT_GT(c.report.n_cells, 36u);
    EXPECT_EQ(half.rows.size() + c.rows.size(), whole.rows.size());
    const double size = whole.end().upper_platen_force.norm();
    EXPECT_NEAR((c.end().upper_platen_force - whole.end().upper_platen_force).norm(), 0, 1e-6 * size);
  }

  // Unknowns and constraints change during the run, so the solver must discard factors of the previous matrix. The same
  // elements are divided, including neighbours on another process.
  TEST(ParallelChanges, AdaptiveRefinement)
  {
    const Options options = adaptive(fixed_steps(LawKind::cosserat_mohr_coulomb));
    as_alone(rectangle(24, 24, 4.), straight_loading(1, {24, -24}, {0, 0.012}), options, 1e-3);
  }

  // Nodes that have reached a platen, for a sample of the initial height `height`.
  int n_captured(const Snapshot &s, const double height)
  {
    int n = 0;
    for (std::size_t k = 0; k < s.position.size(); ++k)
      {
        const double now = s.position[k].y(), initial = now - s.displacement[k].y();
        n += (initial > 1e-8 && now < 1e-8) || (initial < height - 1e-8 && now > height * (1 - s.axial_strain) - 1e-8);
      }
    return n;
  }

  // Material is squeezed out beside a platen and joins it, which adds nodes to the platen.
  TEST(ParallelChanges, SideContact)
  {
    Options options = fixed_steps(LawKind::cosserat_mohr_coulomb);
    options         = with_steps(options, 5e-3);
    const Course c  = as_alone(rectangle(30, 30, 3.75), straight_loading(1, {30, -30}, {0, 0.25}), options, 1e-3);
    if (!is_first())
      return;
    EXPECT_GT(n_captured(c.snapshots.back(), 30), 0);
  }

  // Nodes that reach a platen with free horizontal motion are tied to its first node, which lies on another process.
  TEST(ParallelChanges, SideContactOfAPlatenThatMovesFreely)
  {
    const QuadMesh mesh    = rectangle(30, 30, 3.75);
    Loading        loading = straight_loading(1, {0, -30}, {0, 0.3});
    loading.platens[1][0]  = force(0);
    const Course c         = as_alone(mesh, loading, with_steps(fixed_steps(LawKind::cosserat_mohr_coulomb), 5e-3), 1e-3);
    if (is_first())
      {
        EXPECT_GT(n_captured(c.snapshots.back(), 30), 0);
      }
  }
} // namespace
