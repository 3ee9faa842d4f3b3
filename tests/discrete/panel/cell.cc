// diptych: a cell that is periodic in both directions, driven by strains and stresses
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/contacts/lattice_motion.h"
#include "tests/discrete/small_scenes.h"

namespace
{
  using namespace diptych::tests;

  const double P = 2; // pressure

  // n x n discs of diameter 1 in a triangular lattice of spacing `spacing`; grains lie several periods apart.
  State crystal(const int n, const double spacing)
  {
    State                 state;
    const Eigen::Vector2d e1 = spacing * Eigen::Vector2d::UnitX(), e2 = spacing * Eigen::Vector2d(0.5, std::sqrt(0.75));
    state.periodicity = Lattice{(Eigen::Matrix2d() << n * e1, n * e2).finished()};
    for (int k = 0; k < n * n; ++k)
      add_grain(state.grains, (k % n + n * (k % 3 - 1)) * e1 + (k / n - n * (k % 2)) * e2, 0.5, 1.);
    return state;
  }

  // The controls over time: constant stresses, and strains that grow from 0 at the given rates.
  LatticeDrive drive_of(const Grains &grains, const std::array<bool, 3> &is_stress, const Eigen::Vector3d &values)
  {
    Eigen::Vector3d first = Eigen::Vector3d::Zero(), last = 1e3 * values;
    for (int k = 0; k < 3; ++k)
      if (is_stress[k])
        first[k] = last[k] = values[k];
    return {Eigen::Matrix3d::Identity(), is_stress, {{0., 1e3}, {first, last}}, lattice_inertia(grains)};
  }

  // Each disc has six contacts and each contact a share 1/(3 n^2) of the trace: 2 P A = 3 n^2 f, A = n^2 sqrt(3)/2, so the mean
  // force is P/sqrt(3). At rest the lattice does not accelerate, and the stress of the contacts is the prescribed one.
  TEST(Cell, ACrystalCarriesThePressureInItsContacts)
  {
    for (const ContactSolver solver : {ContactSolver::nsgs, ContactSolver::psor})
      {
        const double step        = 0.02;
        StepSetting  setting     = exact_setting(step);
        setting.solver.solver    = solver;
        setting.solver.tolerance = 1e-12;
        State state              = crystal(6, 1);
        state.lattice()->drive   = drive_of(state.grains, {true, true, true}, {P, P, 0.});
        const StepResult result  = advance(state, setting);
        ASSERT_EQ(result.solve.status, SolveStatus::converged);
        ASSERT_EQ(result.contacts.size(), 108u);
        double force = 0;
        for (const Impulse &r : result.impulses)
          force += r.normal / step / 108;
        EXPECT_NEAR(force, P / std::sqrt(3), 1e-10);
        EXPECT_LT((result.lattice.contacts - Eigen::Vector3d(P, P, 0)).norm(), 1e-10);
        EXPECT_LT(state.lattice()->rate.norm(), 1e-10);
      }
  }

  // Discs apart follow the lattice: x = exp(-strain) x0, without a jump at any edge. The lattice vectors that are left differ
  // from the first ones by whole vectors.
  TEST(Cell, DiscsWithoutContactFollowTheStrain)
  {
    const Eigen::Vector3d rate(-0.4, 0.2, 0.6);
    State                 state = crystal(6, 2);
    state.lattice()->drive      = drive_of(state.grains, {false, false, false}, rate);
    state.lattice()->rate       = start_rate(state.lattice()->drive);
    const State first           = state;
    for (int k = 0; k < 200; ++k)
      ASSERT_EQ(advance(state, exact_setting(0.01)).solve.status, SolveStatus::converged);
    EXPECT_LT((state.lattice()->strain - 2 * rate).norm(), 1e-12);
    const Eigen::Matrix2d exponent = 2 * velocity_gradient(rate);
    Eigen::Matrix2d       map = Eigen::Matrix2d::Identity(), power = map;
    for (int k = 1; k < 30; ++k)
      map += power = (power * exponent / k).eval();
    for (std::size_t i = 0; i < state.grains.size(); ++i)
      EXPECT_LT((state.grains.position[i] - map * first.grains.position[i]).norm(), 1e-11);
    const Eigen::Matrix2d whole = (map * first.lattice()->vectors).inverse() * state.lattice()->vectors;
    EXPECT_LT((whole - whole.array().round().matrix()).norm(), 1e-11);
    EXPECT_GT((whole - Eigen::Matrix2d::Identity()).norm(), 0.5) << "the cell has been sheared enough to be reduced";
    EXPECT_NEAR(state.lattice()->area(), first.lattice()->area() * std::exp(0.4), 1e-10);
  }

  // Controls of the usual tests, in the order of their values.
  struct ElementTest
  {
    const char                  *name;
    Eigen::Matrix3d              form;
    std::array<bool, 3>          is_stress;
    std::vector<Eigen::Vector3d> values;
  };

  std::vector<ElementTest> usual_tests(const double strain)
  {
    const auto rows = [](const std::vector<double> &m) { return Eigen::Matrix3d(Eigen::Matrix3d::Map(m.data()).transpose()); };
    return {{"drained", rows({0, 1, 0, 1, 0, 0, 0, 0, 1}), {false, true, true}, {{0, P, 0}, {strain, P, 0}}},
            {"constant mean stress", rows({0, 1, 0, .5, .5, 0, 0, 0, .5}), {false, true, false}, {{0, P, 0}, {strain, P, 0}}},
            {"shear cycle", rows({0, 0, .5, 0, 1, 0, 1, 0, 0}), {false, true, false}, {{0, P, 0}, {strain, P, 0}, {0, P, 0}}},
            {"rotation",
             Eigen::Matrix3d::Identity(),
             {true, true, true},
             {{P, P, 0}, {P, 1.3 * P, 0}, {P, P, .2 * P}, {P, P, -.2 * P}}}};
  }

  Loading loading_of(const ElementTest &test)
  {
    Loading loading;
    loading.mode            = LoadingMode::path;
    loading.pressure        = P;
    loading.inertial_number = 1e-3;
    loading.path            = {test.form, test.is_stress, test.values, {}};
    for (std::size_t row = 0; row < test.values.size(); ++row)
      loading.path.progress.push_back(double(row));
    loading.stages = {loading.path.progress.back()};
    return loading;
  }

  Options cell_options(const Method method = Method::nscd)
  {
    Options options;
    options.lateral.lateral = Lateral::cell;
    options.method.method   = method;
    options.law.friction    = 0.3;
    return options;
  }

  TimeTable control_of(const Loading &loading, const int k)
  {
    TimeTable table{times_of(loading.path, P, strain_rate(loading, 1, 1)), {}};
    for (const Eigen::Vector3d &row : loading.path.values)
      table.value.push_back(row[k]);
    return table;
  }

  // In every step the prescribed stress drives the cell to round-off. The stress of the contacts differs from it by the inertia
  // of the lattice. Strains end where the path ends, and the ledgers close.
  TEST(Cell, FollowsThePathOfEveryTest)
  {
    for (const Method method : {Method::nscd, Method::penalty})
      for (const ElementTest &test : usual_tests(0.01))
        {
          SCOPED_TRACE(std::string(test.name) + ", " + name_of(method));
          Options options                 = cell_options(method);
          options.method.history_interval = 1;
          const Loading loading           = loading_of(test);
          const Course  course            = loaded(small_sample(100), loading, options);
          ASSERT_EQ(course.report.status, Status::finished) << course.report.message;
          ASSERT_EQ(course.report.halved_steps, 0);
          double inertia = 0;
          for (const HistoryRow &row : course.rows)
            {
              ASSERT_LT(std::abs(row.energy_residual), 1e-11);
              ASSERT_LT(row.momentum_residual, 1e-11);
              for (int k = 0; k < 3; ++k)
                if (test.is_stress[k])
                  {
                    ASSERT_NEAR(test.form.row(k).dot(row.drive_stress),
                                control_of(loading, k).at(row.time - 0.5 * course.report.step), 1e-10 * P);
                  }
              const Eigen::Vector3d contacts(row.stress(0, 0), row.stress(1, 1), row.stress(0, 1));
              inertia += (contacts - row.drive_stress).squaredNorm() / double(course.rows.size());
            }
          EXPECT_LT(std::sqrt(inertia), 0.01 * P);
          const HistoryRow     &end = course.rows.back();
          const Eigen::Vector3d strain(end.strain[0], end.strain[1], 2 * end.strain[2]);
          for (int k = 0; k < 3; ++k)
            if (!test.is_stress[k])
              {
                EXPECT_NEAR(test.form.row(k).dot(strain), test.values.back()[k], 1e-12);
              }
        }
  }

  // The lattice is followed after each sweep, by one thread. 1700 grains make two blocks of contacts.
  TEST(Cell, ThreadsDoNotChangeTheBits)
  {
    std::vector<std::vector<Eigen::Vector2d>> positions;
    Loading                                   loading = loading_of(usual_tests(1e-3)[0]);
    for (const int threads : {1, 3})
      {
        Options options               = cell_options();
        options.threads               = threads;
        SampleOptions sample          = small_sample(1700);
        sample.preparation_steps      = 10;
        sample.quiet_unbalanced_force = 10;
        const Course course           = loaded(sample, loading, options);
        ASSERT_EQ(course.report.status, Status::finished) << course.report.message;
        positions.push_back(course.snapshots.back().position);
      }
    EXPECT_TRUE(positions[0] == positions[1]);
  }

  // No packing carries five times the lateral stress or a tension. The cell then accelerates, and the run ends.
  TEST(Cell, AStressThatNoPackingCarriesEndsTheRun)
  {
    for (const double last : {5 * P, -P})
      {
        ElementTest test    = usual_tests(0.01)[3];
        test.values         = {{P, P, 0}, {P, last, 0}};
        const Course course = loaded(small_sample(100), loading_of(test), cell_options());
        EXPECT_EQ(course.report.status, Status::not_converged);
        EXPECT_NE(course.report.message.find("do not carry the stress"), std::string::npos) << course.report.message;
        EXPECT_GT(course.report.progress, 0.1);
      }
  }

  // Oedometer (eyy, exx, exy) and constant volume (eyy, volume, exy): no stress is prescribed.
  ElementTest strains_only(const double eyy, const double volume)
  {
    const Eigen::Matrix3d form = (Eigen::Matrix3d() << 0, 1, 0, 1, 1, 0, 0, 0, 0.5).finished();
    return {"strains", form, {false, false, false}, {{0, 0, 0}, {eyy, volume, 0}}};
  }

  // The springs have taken up P before the path begins, though no stress is prescribed. Of the first rows, each 2e-5 of strain
  // long, the mean stress is that of the preparation.
  TEST(Cell, SpringsStartAtTheStressOfThePreparation)
  {
    for (const Method method : {Method::penalty, Method::compliant})
      {
        Options options                 = cell_options(method);
        options.method.history_interval = 1;
        options.penalty.stiffness       = 1000;
        const Course course             = loaded(small_sample(100), loading_of(strains_only(1e-4, 0)), options);
        ASSERT_EQ(course.report.status, Status::finished) << course.report.message;
        EXPECT_NEAR(0.5 * course.rows.front().stress.trace(), P, 0.1 * P) << name_of(method);
      }
  }

  TEST(Cell, RigidGrainsEndAPathThatCompressesThem)
  {
    const Course course = loaded(small_sample(100), loading_of(strains_only(0.02, 0.02)), cell_options());
    EXPECT_EQ(course.report.status, Status::not_converged);
    EXPECT_NE(course.report.message.find("no stress of their own"), std::string::npos) << course.report.message;
  }

  // The time of a row follows from its changes; a path needs a cell.
  TEST(Cell, ARowThatChangesNothingIsRefused)
  {
    ElementTest test = usual_tests(0.01)[0];
    EXPECT_THROW(Panel(small_sample(100), loading_of(test), quick_options()), std::invalid_argument);
    test.values.push_back(test.values.back());
    EXPECT_THROW(Panel(small_sample(100), loading_of(test), cell_options()), std::invalid_argument);
  }
} // namespace
