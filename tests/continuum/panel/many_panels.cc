// diptych: many panels in one process give the results of separate processes and release their memory
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <malloc.h>

#include "tests/continuum/continuum_scenes.h"

namespace
{
  using namespace diptych::continuum::tests;
  using diptych::tests::Folder;

  // Bytes that are allocated and not released.
  double bytes_in_use()
  {
    const struct mallinfo2 now = mallinfo2();
    return double(now.uordblks + now.hblkhd);
  }

  // The law has period 3 in k, the linear solver 4, the mesh 2 and the friction 5.
  constexpr int n_turns = 12;
  Course        turn(const int k)
  {
    Options options = with_steps({}, 2e-3);
    options.law     = k % 3 == 0 ? LawKind::cosserat_mohr_coulomb : k % 3 == 1 ? LawKind::mohr_coulomb : LawKind::drucker_prager;
    options.material.friction_angle_peak = 18 + k % n_turns % 5;
    options.linear_solver                = k % 4 == 3 ? LinearChoice::amg : LinearChoice::direct;
    return course(rectangle(24, 24, 3.), straight_loading(1, {24, -24}, {0, 0.012}), k % 2 ? adaptive(options) : options);
  }

  std::vector<double> numbers(const Course &course)
  {
    EXPECT_EQ(course.report.status, Status::finished) << course.report.message;
    std::vector<double> values;
    for (const HistoryRow &row : course.rows)
      {
        values.insert(values.end(), row.mean_stress.data(), row.mean_stress.data() + row.mean_stress.size());
        values.insert(values.end(), {row.upper_platen_force.x(), row.upper_platen_force.y()});
      }
    for (const Eigen::Vector2d &x : course.snapshots.back().position)
      values.insert(values.end(), {x.x(), x.y()});
    return values;
  }

  // Run in a separate process. DIPTYCH_TURN is the number of the turn, DIPTYCH_NUMBERS the file for its results.
  TEST(ManyPanels, DISABLED_OneTurn)
  {
    const char *which = std::getenv("DIPTYCH_TURN"), *file = std::getenv("DIPTYCH_NUMBERS");
    ASSERT_TRUE(which && file);
    const std::vector<double> values = numbers(turn(std::atoi(which)));
    std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char *>(values.data()), std::streamsize(values.size() * sizeof(double)));
  }

  // Starts without this process's environment, which contains MPI's own variables. OpenMPI 5 needs HOME, and OpenBLAS must choose
  // the same kernels.
  std::vector<double> numbers_of_a_fresh_process(const int k)
  {
    const Folder      folder;
    const std::string file      = folder / "numbers";
    const char       *kernels   = std::getenv("OPENBLAS_CORETYPE");
    const std::string variables = (kernels ? "env -i OPENBLAS_CORETYPE='" + std::string(kernels) + "' " : "env -i ") +
                                  "HOME=/tmp PATH=/usr/bin:/bin OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
                                  "OMP_NUM_THREADS=1 DIPTYCH_TURN=" +
                                  std::to_string(k) + " DIPTYCH_NUMBERS='" + file + "' ";
    const std::string program = "'" + std::filesystem::read_symlink("/proc/self/exe").string() + "'";
    const std::string command = variables + program +
                                " --gtest_filter=ManyPanels.DISABLED_OneTurn --gtest_also_run_disabled_tests >/dev/null 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    std::ifstream       in(file, std::ios::binary);
    std::vector<double> values;
    for (double value; in.read(reinterpret_cast<char *>(&value), sizeof value);)
      values.push_back(value);
    return values;
  }

  // Five of every turn. Two of each first fill what the libraries keep once. After that no more memory may stay in use.
  TEST(ManyPanels, KeepNoMemoryAndGiveTheBitsOfAFreshProcess)
  {
    std::vector<std::vector<double>> fresh;
    for (int k = 0; k < n_turns; ++k)
      {
        fresh.push_back(numbers_of_a_fresh_process(k));
        ASSERT_GT(fresh.back().size(), 200u);
      }
    double before = 0;
    for (int k = 0; k < 5 * n_turns; ++k)
      {
        if (k == 2 * n_turns)
          before = bytes_in_use();
        ASSERT_EQ(numbers(turn(k)), fresh[std::size_t(k % n_turns)]) << "panel " << k;
      }
    const double grown = bytes_in_use() - before;
    // 36 panels of 8 x 8 biquadratic elements, 289 nodes: a panel that kept its displacements would add 36 x 4.6 kB. Pools of
    // the libraries still grow by 6 to 7 kB, ever more slowly.
    EXPECT_LT(grown, 20000);
  }

  // Two panels side by side, one of them on its own communicator, give the results of each of them running separately.
  TEST(ManyPanels, DoNotInfluenceEachOther)
  {
    const QuadMesh mesh    = rectangle(14, 20, 4.);
    const Loading  loading = straight_loading(1, {20, -20}, {0.002, 0.004});
    Options        soft = with_steps({}, 1e-3), stiff = soft;
    stiff.material.elastic.youngs_modulus = 2000;
    MPI_Comm own;
    MPI_Comm_dup(MPI_COMM_SELF, &own);
    {
      Panel a(mesh, Units(), loading, soft), b(mesh, Units(), loading, stiff, {}, own);
      EXPECT_EQ(a.prepare(), Status::finished);
      EXPECT_EQ(b.prepare(), Status::finished);
      for (const int stage : {1, 2})
        {
          EXPECT_EQ(a.advance_to(stage), Status::finished);
          EXPECT_EQ(b.advance_to(stage), Status::finished);
        }
      EXPECT_EQ(a.snapshot().mean_stress, finished(mesh, loading, soft).snapshots.back().mean_stress);
      EXPECT_EQ(b.snapshot().mean_stress, finished(mesh, loading, stiff).snapshots.back().mean_stress);
      EXPECT_NE(a.snapshot().mean_stress, b.snapshot().mean_stress);
    }
    MPI_Comm_free(&own);
  }
} // namespace
