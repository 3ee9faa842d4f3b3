// diptych: the boundary-value problem: closed forms, balance, stages, honest ends
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>
#include <filesystem>
#include <fstream>

#include <unistd.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include "continuum/mesh.h"
#include "continuum/output.h"
#include "continuum/panel.h"

namespace
{
  using namespace diptych::continuum;

  std::string temporary_path(const std::string &name)
  {
    return (std::filesystem::path(testing::TempDir()) / ("diptych" + std::to_string(::getpid()) + name)).string();
  }

  // Mesh file of an outline that lives as long as the test.
  struct MeshFile
  {
    std::string path = temporary_path(".msh");
    MeshSummary summary;

    MeshFile(const Outline &outline, const double element_size)
        : summary(make_mesh(outline, element_size, path))
    {}
    ~MeshFile() { std::filesystem::remove(path); }
  };

  Outline rectangle(const double width, const double height, const int points = 2, const double waviness = 0)
  {
    Outline outline;
    for (int k = 0; k < points; ++k)
      {
        const double y    = height * k / (points - 1);
        const double wave = waviness * std::sin(2 * M_PI * 3 * y / height);
        outline.left.emplace_back(-wave, y);
        outline.right.emplace_back(width + wave, y);
      }
    return outline;
  }

  struct Course
  {
    Report                  report;
    std::vector<Snapshot>   snapshots;
    std::vector<HistoryRow> rows;
  };

  Course course(const std::string &mesh, const Loading &loading, const Options &options)
  {
    Course    result;
    Callbacks callbacks;
    callbacks.on_stage = [&](const Snapshot &s) { result.snapshots.push_back(s); };
    callbacks.on_step  = [&](const HistoryRow &row) { result.rows.push_back(row); };
    result.report      = run(mesh, loading, options, callbacks);
    return result;
  }

  Options no_softening(const double friction, const double dilatancy, const double cohesion)
  {
    Options options;
    options.mohr_coulomb.friction_angle_peak = options.mohr_coulomb.friction_angle_residual = friction;
    options.mohr_coulomb.dilatancy_angle_peak = options.mohr_coulomb.dilatancy_angle_residual = dilatancy;
    options.mohr_coulomb.cohesion                                                             = cohesion;
    return options;
  }

  // Plane strain between smooth platens: s1 = s3 Kp + 2 c sqrt(Kp), Kp = (1 + sin phi)/(1 - sin phi) = 3 at 30 degrees: 3.346410
  // and 3.034641 at s3 = 1. The lateral force follows the height, so at 5 % strain s3 = 0.95 on the initial geometry.
  TEST(Panel, OneElementReachesTheClosedFormStrength)
  {
    const MeshFile mesh(rectangle(1, 1), 1.);
    Loading        loading;
    loading.upper_platen_travel = {0, -1};
    loading.platens             = "smooth";
    loading.stages              = {0.05};
    for (const auto &[cohesion, expected] : {std::pair{0.1, 3.346410}, std::pair{0.01, 3.034641}})
      for (const double dilatancy : {0., 10., 30.})
        {
          const Course c = course(mesh.path, loading, no_softening(30, dilatancy, cohesion));
          ASSERT_EQ(c.report.status, Status::finished) << c.report.message;
          EXPECT_NEAR(c.rows.back().mean_stress(0, 0), 0.95, 1e-6);
          EXPECT_NEAR(c.rows.back().mean_stress(1, 1) + 3 * 0.05, expected, 2e-6) << "c " << cohesion << ", psi " << dilatancy;
        }
  }

  // Elastic plane strain at constant lateral pressure: d s_yy = E/(1 - nu^2) d eps, to first order in the strain, because the
  // lateral force follows the height.
  TEST(Panel, ElasticPlaneStrainModulus)
  {
    const MeshFile mesh(rectangle(2, 3), 1.);
    Loading        loading;
    loading.upper_platen_travel = {0, -3};
    loading.platens             = "smooth";
    loading.stages              = {1e-4};
    Options options;
    options.law          = "linear_elastic";
    options.initial_step = 1e-4;
    const Course c       = course(mesh.path, loading, options);
    ASSERT_EQ(c.report.status, Status::finished) << c.report.message;
    const double modulus = (c.rows.back().mean_stress(1, 1) - 1) / 1e-4;
    EXPECT_NEAR(modulus, 500 / (1 - 0.2 * 0.2), 1e-3 * 500);
  }

  TEST(Panel, FortyFiveDegreeShearBalancesAndLandsOnItsStages)
  {
    const MeshFile mesh(rectangle(14, 20, 11, 0.15), 2.);
    Loading        loading;
    loading.upper_platen_travel = {20, -20};
    loading.stages              = {0, 0.004, 0.01};
    Options options;
    options.mohr_coulomb.softening_strain = 0.5;
    const Course c                        = course(mesh.path, loading, options);
    ASSERT_EQ(c.report.status, Status::finished) << c.report.message;
    ASSERT_EQ(c.snapshots.size(), 3u);
    EXPECT_EQ(c.snapshots[1].axial_strain, 0.004);
    EXPECT_EQ(c.snapshots[2].axial_strain, 0.01);
    const HistoryRow &last  = c.rows.back();
    const double      scale = last.upper_platen_force.norm();
    EXPECT_GT(scale, 10);
    // The lateral pressure acts horizontally, equal on both sides: the platens balance each other.
    EXPECT_NEAR((last.lower_platen_force + last.upper_platen_force).norm() / scale, 0, 1e-4);
    EXPECT_LT(last.upper_platen_force.y(), 0) << "the upper platen presses down";
    EXPECT_GT(last.stress_ratio, 0.2);
    EXPECT_LT(last.stress_ratio, std::sin(20.5 * M_PI / 180) + 0.02);

    // The snapshot's means are the history's, its nodes carry the whole area, and the upper platen has travelled.
    const Snapshot &s    = c.snapshots.back();
    double          area = 0, weight = 0;
    Eigen::Matrix3d stress = Eigen::Matrix3d::Zero();
    for (const CellState &cell : s.cell_state)
      area += cell.area, stress += cell.area * cell.stress;
    for (const double w : s.weight)
      weight += w;
    EXPECT_NEAR(weight, s.area, 1e-9 * s.area);
    EXPECT_NEAR(area, s.area, 1e-9 * s.area);
    EXPECT_NEAR((stress / area - last.mean_stress).norm(), 0, 2e-2);
    double top = 0;
    for (std::size_t k = 0; k < s.position.size(); ++k)
      if (s.position[k].y() > 19.8 - 1e-9)
        top = std::max(top, (s.displacement[k] - Eigen::Vector2d(0.2, -0.2)).norm());
    EXPECT_NEAR(top, 0, 1e-9);
  }

  TEST(Panel, StopsAtTheNextStepOnRequest)
  {
    const MeshFile mesh(rectangle(4, 6), 2.);
    Loading        loading;
    loading.upper_platen_travel = {6, -6};
    loading.stages              = {0.05};
    int       steps             = 0;
    Callbacks callbacks;
    callbacks.on_step        = [&](const HistoryRow &) { ++steps; };
    callbacks.stop_requested = [&] { return steps >= 3; };
    const Report report      = run(mesh.path, loading, {}, callbacks);
    EXPECT_EQ(report.status, Status::stopped_by_user);
    EXPECT_EQ(steps, 3);
    EXPECT_GT(report.axial_strain, 0);
    EXPECT_LT(report.axial_strain, 0.05);
  }

  TEST(Panel, SaysHowFarItCameWhenItCannotGoOn)
  {
    const MeshFile mesh(rectangle(14, 20), 2.);
    Loading        loading;
    loading.upper_platen_travel = {20, -20};
    loading.stages              = {0.02};
    Options options;
    options.max_newton_iterations = 1; // no plastic step converges in one
    options.min_step              = 1e-4;
    const Report report           = run(mesh.path, loading, options);
    EXPECT_EQ(report.status, Status::not_converged);
    EXPECT_LT(report.axial_strain, 0.02);
    EXPECT_FALSE(report.message.empty());
  }

  TEST(Panel, WrongLoadingIsRefused)
  {
    Loading loading;
    loading.upper_platen_travel = {0, 1};
    loading.stages              = {0.01};
    EXPECT_THROW(validate(loading), std::invalid_argument);
    loading.upper_platen_travel = {0, -1};
    loading.stages              = {0.01, 0.005};
    EXPECT_THROW(validate(loading), std::invalid_argument);
    Options options;
    options.min_step = 1;
    EXPECT_THROW(validate(options), std::invalid_argument);
  }

  TEST(Mesh, OfAWavyOutlineIsAllQuadrilateralsAndFillsIt)
  {
    const Outline  outline = rectangle(20, 30, 16, 0.4);
    const MeshFile mesh(outline, 2.);
    double         twice   = 0;
    auto           polygon = outline.right;
    polygon.insert(polygon.end(), outline.left.rbegin(), outline.left.rend());
    for (std::size_t k = 0; k < polygon.size(); ++k)
      {
        const Eigen::Vector2d &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
        twice += a.x() * b.y() - a.y() * b.x();
      }
    EXPECT_NEAR(mesh.summary.area, twice / 2, 0.005 * twice / 2);
    EXPECT_GT(mesh.summary.n_cells, 100u);
    EXPECT_LT(mesh.summary.n_cells, 260u);          // 600 / 4 = 150
    const MeshSummary read = check_mesh(mesh.path); // throws unless all are quadrilaterals with all four ids
    EXPECT_EQ(read.n_cells, mesh.summary.n_cells);
    EXPECT_FALSE(std::filesystem::exists(mesh.path + ".part"));
  }

  TEST(Mesh, TrianglesAreRefusedBeforeDealIiReadsThem)
  {
    const std::string path = temporary_path("_triangle.msh");
    std::ofstream(path) << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n"
                           "$Elements\n4\n1 1 2 1 1 1 2\n2 1 2 2 2 2 3\n3 1 2 3 3 3 1\n4 2 2 1 1 1 2 3\n$EndElements\n";
    try
      {
        (void)check_mesh(path);
        FAIL() << "no error";
      }
    catch (const std::runtime_error &error)
      {
        EXPECT_NE(std::string(error.what()).find(path), std::string::npos) << error.what();
      }
    std::filesystem::remove(path);
  }

  TEST(Mesh, AnOutlineThatIsNoSampleIsRefused)
  {
    Outline outline = rectangle(2, 3);
    std::swap(outline.left, outline.right);
    EXPECT_THROW((void)make_mesh(outline, 1., temporary_path("_none.msh")), std::invalid_argument);
    EXPECT_FALSE(std::filesystem::exists(temporary_path("_none.msh")));
  }

  TEST(Output, SnapshotsSurviveTheFile)
  {
    const MeshFile mesh(rectangle(4, 6), 2.);
    Loading        loading;
    loading.upper_platen_travel = {6, -6};
    loading.stages              = {0, 0.002};
    const Course      c         = course(mesh.path, loading, {});
    const std::string folder    = temporary_path("_results");
    std::filesystem::create_directory(folder);
    ResultFiles files(folder);
    for (const HistoryRow &row : c.rows)
      files.add(row);
    for (const Snapshot &s : c.snapshots)
      files.add(s);
    files.finish();
    const std::vector<Snapshot> read = read_snapshots(folder + "/continuum.h5");
    ASSERT_EQ(read.size(), c.snapshots.size());
    for (std::size_t k = 0; k < read.size(); ++k)
      {
        EXPECT_EQ(read[k].axial_strain, c.snapshots[k].axial_strain);
        EXPECT_EQ(read[k].position, c.snapshots[k].position);
        EXPECT_EQ(read[k].cells, c.snapshots[k].cells);
        EXPECT_EQ(read[k].cell_state.back().stress, c.snapshots[k].cell_state.back().stress);
        EXPECT_EQ(read[k].upper_platen_force, c.snapshots[k].upper_platen_force);
      }
    for (const char *name : {"continuum.csv", "continuum.pvd", "continuum.xdmf"})
      EXPECT_TRUE(std::filesystem::exists(folder + "/" + name)) << name;
    std::filesystem::remove_all(folder);
  }
} // namespace

int main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
