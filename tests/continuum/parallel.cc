// diptych: several processes walk as one. One process writes its courses down, several are held to them.
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cstdlib>
#include <fstream>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include "tests/continuum/continuum_scenes.h"

namespace
{
  using namespace diptych::continuum;
  using namespace diptych::continuum::tests;
  namespace fs = std::filesystem;

  unsigned int n_processes()
  {
    return dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  }
  bool is_first()
  {
    return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  }

  // Where the courses of one process stand.
  fs::path folder()
  {
    const char *named = std::getenv("DIPTYCH_SERIAL_COURSES");
    return named ? fs::path(named) : fs::path(testing::TempDir());
  }

  // Made by the first process, known to all.
  struct SharedMesh
  {
    std::string path;

    SharedMesh(const std::string &name, const double width, const double height, const double element_size)
        : path((folder() / ("parallel_" + name + std::to_string(n_processes()) + ".msh")).string())
    {
      if (is_first())
        (void)make_rectangle_mesh({width, height, 0, element_size}, path);
      MPI_Barrier(MPI_COMM_WORLD);
    }
    ~SharedMesh()
    {
      MPI_Barrier(MPI_COMM_WORLD);
      if (is_first())
        fs::remove(path);
    }
  };

  constexpr int n_columns = 9, first_force = 3;
  using Row = std::array<double, n_columns>;

  Row numbers(const HistoryRow &row)
  {
    return {row.axial_strain,           row.stress_ratio,           row.volumetric_strain,      row.upper_platen_force.x(),
            row.upper_platen_force.y(), row.lower_platen_force.x(), row.lower_platen_force.y(), row.dissipation,
            double(row.n_cells)};
  }

  // Writes the course (one process) or compares with the one that was written (several). `relative`: to the largest of a column.
  void write_or_compare(const std::string &name, const Course &c, const double relative)
  {
    EXPECT_EQ(c.report.status, Status::finished) << c.report.message;
    if (!is_first())
      {
        EXPECT_TRUE(c.rows.empty()) << "only the first process is told";
        return;
      }
    ASSERT_GT(c.rows.size(), 3u);
    const fs::path file = folder() / ("parallel_" + name + ".txt");
    if (n_processes() == 1)
      {
        EXPECT_GT(c.end().stress_ratio, c.rows.front().stress_ratio + 0.1) << "it was loaded";
        std::ofstream out(file);
        out.precision(17);
        for (const HistoryRow &row : c.rows)
          for (const double value : numbers(row))
            out << value << '\n';
        return;
      }
    std::ifstream       in(file);
    std::vector<double> expected;
    for (double value; in >> value;)
      expected.push_back(value);
    ASSERT_EQ(expected.size(), n_columns * c.rows.size()) << file << ": written by one process first";
    for (int k = 0; k < n_columns; ++k)
      {
        double     scale    = 1e-9;
        const bool is_force = k >= first_force && k < first_force + 4; // measured by the largest of their components
        for (std::size_t row = 0; row < c.rows.size(); ++row)
          for (int j = is_force ? first_force : k; j < (is_force ? first_force + 4 : k + 1); ++j)
            scale = std::max(scale, std::abs(expected[row * n_columns + j]));
        for (std::size_t row = 0; row < c.rows.size(); ++row)
          EXPECT_NEAR(numbers(c.rows[row])[k], expected[row * n_columns + k], relative * scale)
            << name << ": column " << k << ", row " << row;
      }
    // The snapshot is whole.
    const Snapshot &s    = c.snapshots.back();
    double          area = 0;
    for (const double w : s.weight)
      area += w;
    EXPECT_NEAR(area, s.area, 1e-9 * s.area);
    EXPECT_EQ(int(s.cells.size()), c.end().n_cells);
    EXPECT_NEAR(1 - c.end().volumetric_strain, s.area / c.snapshots.front().area, 1e-9);
  }

  Options fixed_steps(const std::string &law)
  {
    Options options   = with_steps({}, 1e-3);
    options.law       = law;
    options.tolerance = 1e-7;
    return options;
  }

  TEST(Parallel, FortyFiveDegreeShear)
  {
    const SharedMesh mesh("shear", 14, 20, 2.);
    write_or_compare("shear", course(mesh.path, straight_loading(1, {20, -20}, {0, 0.01}), fixed_steps("cosserat_mohr_coulomb")),
                     1e-4);
  }

  TEST(Parallel, MultigridSolver)
  {
    const SharedMesh mesh("amg", 14, 20, 2.);
    Options          options = fixed_steps("mohr_coulomb");
    options.linear_solver    = "amg";
    write_or_compare("amg", course(mesh.path, straight_loading(1, {20, -20}, {0, 0.006}), options), 1e-4);
  }

  // Pairs of nodes, and a platen's nodes that move as one, lie on different processes.
  TEST(Parallel, PlaneShearBetweenPeriodicSides)
  {
    const SharedMesh mesh("plane", 16, 8, 2.);
    Loading          loading = straight_loading(1, {8, 0}, {0, 0.01});
    loading.lateral          = PeriodicSides{0.};
    loading.platens[1][1]    = force(-16);
    write_or_compare("plane", course(mesh.path, loading, fixed_steps("mohr_coulomb")), 1e-4);
  }

  TEST(Parallel, RigidWallUnderPressure)
  {
    const SharedMesh mesh("rigid", 8, 16, 2.);
    Loading          loading = straight_loading(1, {0, -16}, {0, 0.01});
    loading.lateral          = RigidSides();
    Options options          = fixed_steps("mohr_coulomb");
    options.platens          = "smooth";
    options.element          = "q1_bbar";
    options.weak_spot_strain = 0.05;
    write_or_compare("rigid", course(mesh.path, loading, options), 1e-4);
  }

  // Stress handed over by the first process reaches the cells of the others: it grows from left to right, and comes to rest.
  TEST(Parallel, MappedStress)
  {
    const SharedMesh mesh("mapped", 12, 8, 2.);
    Options          options  = fixed_steps("mohr_coulomb");
    options.initial_stress    = "mapped";
    options.material.cohesion = 1;
    Callbacks callbacks;
    callbacks.initial_stress = [](const Snapshot &s) {
      std::vector<Eigen::Matrix2d> stress;
      for (const auto &cell : s.cells)
        {
          stress.push_back(Eigen::Matrix2d::Identity());
          stress.back()(1, 1) = 1 + 0.05 * s.position[cell[8]].x();
        }
      return stress;
    };
    write_or_compare("mapped", course(mesh.path, straight_loading(1, {0, -8}, {0, 0.004}), options, callbacks), 1e-4);
  }

  // A checkpoint of one process is taken up by several.
  TEST(Parallel, ACheckpointOfOneProcessIsTakenUpByAll)
  {
    const std::string file = (folder() / "parallel_restart.h5").string();
    const SharedMesh  mesh("restart", 14, 20, 4.);
    const Loading     loading = straight_loading(1, {20, -20}, {0, 0.008});
    const Options     options = fixed_steps("cosserat_mohr_coulomb");
    if (n_processes() == 1)
      {
        int       asked = 0;
        Callbacks callbacks;
        callbacks.checkpoint_file = file;
        callbacks.stop_requested  = [&] { return ++asked == 4; };
        const Course half         = course(mesh.path, loading, options, callbacks);
        EXPECT_EQ(half.report.status, Status::stopped_by_user);
        EXPECT_TRUE(fs::exists(file));
        const Course whole = finished(mesh.path, loading, options);
        std::ofstream(folder() / "parallel_restart.txt") << std::scientific << whole.end().upper_platen_force.transpose() << '\n';
        return;
      }
    Callbacks callbacks;
    callbacks.checkpoint_file = file;
    callbacks.resume          = true;
    const Course c            = course(mesh.path, loading, options, callbacks);
    EXPECT_EQ(c.report.status, Status::finished) << c.report.message;
    if (!is_first())
      return;
    std::ifstream in(folder() / "parallel_restart.txt");
    double        x = 0, y = 0;
    ASSERT_TRUE(in >> x >> y);
    EXPECT_EQ(c.rows.front().step, 4) << "three steps were made before";
    EXPECT_NEAR(c.end().upper_platen_force.x(), x, 1e-4 * std::hypot(x, y));
    EXPECT_NEAR(c.end().upper_platen_force.y(), y, 1e-4 * std::hypot(x, y));
  }

  // Unknowns and constraints change on the way: the solver's factors belong to a matrix that is no more. The same elements are
  // divided, neighbours on another process included.
  TEST(ParallelChanges, AdaptiveRefinement)
  {
    const SharedMesh mesh("adaptive", 24, 24, 4.);
    Options          options     = fixed_steps("cosserat_mohr_coulomb");
    options.refinement           = "adaptive";
    options.refinement_threshold = 0.5;
    write_or_compare("adaptive", course(mesh.path, straight_loading(1, {24, -24}, {0, 0.012}), options), 1e-3);
  }

  // Nodes that have come to a platen, of a sample that was `height` high.
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

  // Material is squeezed out beside a platen and taken up by it, which adds to the platen's nodes.
  TEST(ParallelChanges, SideContact)
  {
    const SharedMesh mesh("contact", 30, 30, 3.75);
    Options          options = fixed_steps("cosserat_mohr_coulomb");
    options                  = with_steps(options, 5e-3);
    const Course c           = course(mesh.path, straight_loading(1, {30, -30}, {0, 0.25}), options);
    write_or_compare("contact", c, 1e-3);
    if (!is_first())
      return;
    EXPECT_GT(n_captured(c.snapshots.back(), 30), 0);
  }

  // The nodes that come to a platen which moves freely sideways are tied to its first one, that lies on another process.
  TEST(ParallelChanges, SideContactOfAPlatenThatMovesFreely)
  {
    const SharedMesh mesh("tied", 30, 30, 3.75);
    Loading          loading = straight_loading(1, {0, -30}, {0, 0.3});
    loading.platens[1][0]    = force(0);
    const Course c           = course(mesh.path, loading, with_steps(fixed_steps("cosserat_mohr_coulomb"), 5e-3));
    write_or_compare("tied", c, 1e-3);
    if (is_first())
      {
        EXPECT_GT(n_captured(c.snapshots.back(), 30), 0);
      }
  }
} // namespace
