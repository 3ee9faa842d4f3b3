// diptych: an interrupted and resumed run has the bits of an uninterrupted one
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tests/continuum/continuum_scenes.h"

namespace
{
  using namespace diptych::continuum::tests;

  Options options_of(const LawKind law, const bool is_adaptive = false)
  {
    Options options = with_steps({}, 1e-3);
    options.law     = law;
    return is_adaptive ? adaptive(options) : options;
  }

  // All entries of a row except the CPU seconds.
  void expect_same_bits(const HistoryRow &a, const HistoryRow &b)
  {
    std::vector<double> numbers[2];
    for (const int which : {0, 1})
      visit_columns(which ? b : a, [&](const std::string &name, const auto &value, const char *, const char *) {
        if constexpr (std::is_arithmetic_v<std::decay_t<decltype(value)>>)
          if (name.find("_cpu_s") == std::string::npos)
            numbers[which].push_back(double(value));
      });
    EXPECT_EQ(numbers[0], numbers[1]) << "step " << a.step << " and " << b.step;
  }

  struct Halves
  {
    const Course &first, &whole;
  };

  void expect_the_rest(const QuadMesh &mesh, const Loading &loading, const Options &options, const Halves &of)
  {
    ASSERT_EQ(of.first.report.status, Status::stopped_by_user);
    const std::size_t interrupted_after = of.first.rows.size();
    const Course      second            = resumed(mesh, loading, options, of.first.checkpoint);
    ASSERT_EQ(second.report.status, Status::finished) << second.report.message;
    ASSERT_EQ(interrupted_after + second.rows.size(), of.whole.rows.size());
    for (std::size_t k = 0; k < of.whole.rows.size(); ++k)
      expect_same_bits(k < interrupted_after ? of.first.rows[k] : second.rows[k - interrupted_after], of.whole.rows[k]);
    const Snapshot &a = second.snapshots.back(), &b = of.whole.snapshots.back();
    EXPECT_EQ(a.position, b.position);
    ASSERT_EQ(a.cell_state.size(), b.cell_state.size());
    for (std::size_t c = 0; c < a.cell_state.size(); ++c)
      EXPECT_EQ(a.cell_state[c].stress, b.cell_state[c].stress) << "cell " << c;
    EXPECT_EQ(second.report.localisation_progress, of.whole.report.localisation_progress);
  }

  // A run on one process is interrupted before any of its steps and resumed by a new panel. Its rows must equal those of an
  // uninterrupted run, bit for bit. This holds for divided elements, mapped stress, multigrid and factors.
  void expect_that_it_goes_on(const QuadMesh &mesh, const Loading &loading, const Options &options, Wishes wishes = {})
  {
    const Course whole = course(mesh, loading, options, wishes);
    ASSERT_EQ(whole.report.status, Status::finished) << whole.report.message;
    ASSERT_GT(whole.rows.size(), 6u);
    for (std::size_t interrupted_after = 1; interrupted_after < whole.rows.size(); interrupted_after += whole.rows.size() / 4)
      {
        SCOPED_TRACE("after " + std::to_string(interrupted_after) + " rows");
        Wishes stopped         = wishes;
        stopped.stop_requested = [&](const std::size_t n_rows) { return n_rows >= interrupted_after; };
        const Course first     = course(mesh, loading, options, stopped);
        ASSERT_EQ(first.rows.size(), interrupted_after);
        expect_the_rest(mesh, loading, options, {first, whole});
      }
  }

  // Stops between two Newton iterations. Three successive checks are tried, because a step of two iterations makes two of them.
  void expect_resume_within_steps(const QuadMesh &mesh, const Loading &loading, const Options &options)
  {
    const Course whole = course(mesh, loading, options);
    int          calls = 0;
    Wishes       asking;
    asking.stop_requested = [&](const std::size_t n_rows) { return n_rows > 0 && ++calls < 0; };
    const Course asked    = course(mesh, loading, options, asking);
    ASSERT_EQ(asked.rows.size(), whole.rows.size());
    for (std::size_t k = 0; k < whole.rows.size(); ++k)
      expect_same_bits(asked.rows[k], whole.rows[k]);
    ASSERT_GT(calls, int(whole.rows.size()) + 2) << "more than one check per step";
    for (const int last : {2, calls / 2, calls / 2 + 1, calls / 2 + 2, calls - 1})
      {
        SCOPED_TRACE("at check " + std::to_string(last) + " of " + std::to_string(calls));
        int    n = 0;
        Wishes stopped;
        stopped.stop_requested = [&](const std::size_t n_rows) { return n_rows > 0 && ++n >= last; };
        const Course first     = course(mesh, loading, options, stopped);
        EXPECT_EQ(n, last) << "the panel stops at the first positive answer";
        expect_the_rest(mesh, loading, options, {first, whole});
      }
  }

  TEST(Restart, ContinuesWithTheSameBits)
  {
    const QuadMesh mesh    = outline_mesh(wavy_outline(24, 24, 13, 0.2), 4.);
    const Loading  loading = straight_loading(1, {24, -24}, {0, 0.004, 0.012});
    for (const LawKind law : {LawKind::cosserat_mohr_coulomb, LawKind::gradient_mohr_coulomb, LawKind::drucker_prager})
      expect_that_it_goes_on(mesh, loading, options_of(law));
  }

  // With factors and with a multigrid preconditioner. The iterations of the rejected step have replaced both.
  TEST(Restart, ContinuesWithTheSameBitsFromWithinAStep)
  {
    for (const LinearChoice solver : {LinearChoice::direct, LinearChoice::amg})
      {
        Options options       = options_of(LawKind::mohr_coulomb);
        options.linear_solver = solver;
        expect_resume_within_steps(rectangle(14, 20, 2.), straight_loading(1, {20, -20}, {0, 0.01}), options);
      }
  }

  TEST(Restart, ContinuesWithTheSameBitsOnDividedElements)
  {
    const Loading loading = straight_loading(1, {24, -24}, {0, 0.004, 0.02});
    Options       options = options_of(LawKind::cosserat_mohr_coulomb, true);
    const Course  whole   = course(rectangle(24, 24, 4.), loading, options);
    EXPECT_GT(whole.report.n_cells, 36u);
    expect_that_it_goes_on(rectangle(24, 24, 4.), loading, options);
  }

  TEST(Restart, ContinuesWithTheSameBitsWhereTheLoadHasMovedTheCone)
  {
    Options options                       = options_of(LawKind::cosserat_mohr_coulomb, true);
    options.material.hardening            = kind_of<KinematicHardening>;
    options.material.solid_fraction_start = 0.85;
    expect_that_it_goes_on(rectangle(24, 24, 4.), straight_loading(1, {24, -24}, {0, 0.004, 0.01}), options);
  }

  TEST(Restart, ContinuesWithTheSameBitsWithAMultigridPreconditioner)
  {
    Options options       = options_of(LawKind::mohr_coulomb);
    options.linear_solver = LinearChoice::amg;
    expect_that_it_goes_on(rectangle(14, 20, 2.), straight_loading(1, {20, -20}, {0, 0.01}), options);
  }

  TEST(Restart, ContinuesWithTheSameBitsFromAMappedStress)
  {
    Options options        = options_of(LawKind::cosserat_mohr_coulomb, true);
    options.initial_stress = InitialStress::mapped;
    Wishes wishes;
    wishes.initial_stress = [](const Snapshot &s) {
      std::vector<Eigen::Matrix2d> stress;
      for (const auto &cell : s.cells)
        stress.push_back((1 + 0.01 * s.position[cell[8]].x()) * Eigen::Matrix2d::Identity());
      return stress;
    };
    expect_that_it_goes_on(rectangle(24, 24, 4.), straight_loading(1, {24, -24}, {0, 0.01}), options, wishes);
  }

  // Material has reached a platen beside it, and a platen moves freely.
  TEST(Restart, ContinuesWithTheSameBitsInSideContact)
  {
    Loading loading       = straight_loading(1, {0, -30}, {0, 0.3});
    loading.platens[1][0] = force(0);
    expect_that_it_goes_on(rectangle(30, 30, 3.75), loading, with_steps(options_of(LawKind::cosserat_mohr_coulomb), 5e-3));
  }

  // The preconditioner determines the bits of the next solve. If its matrix is missing, the factors must not be recomputed
  // silently.
  TEST(Restart, MatricesOfAnotherLengthAreRefused)
  {
    const Loading loading = straight_loading(1, {14, -20}, {0.002});
    for (const LinearChoice choice : {LinearChoice::direct, LinearChoice::amg})
      {
        Options options       = options_of(LawKind::mohr_coulomb);
        options.linear_solver = choice;
        const auto go_on      = [&](const Checkpoint &checkpoint) {
          (void)resumed(rectangle(14, 20, 2.), loading, options, checkpoint);
        };
        const Checkpoint whole = course(rectangle(14, 20, 2.), loading, options).checkpoint;
        ASSERT_FALSE(whole.preconditioner_is_stale);
        ASSERT_FALSE(whole.factorised_matrix.empty());
        EXPECT_NO_THROW(go_on(whole));
        for (const std::size_t length : {std::size_t(0), std::size_t(5), whole.factorised_matrix.size() - 1})
          {
            Checkpoint cut = whole;
            cut.factorised_matrix.resize(length);
            EXPECT_THROW(go_on(cut), std::invalid_argument) << length;
          }
      }
  }

  TEST(Restart, ACheckpointOfAnotherMeshIsRefused)
  {
    const Loading    loading = straight_loading(1, {8, -8}, {0.002});
    const Options    options = options_of(LawKind::mohr_coulomb);
    const Checkpoint from    = course(rectangle(8, 8, 2.), loading, options).checkpoint;
    EXPECT_THROW((void)resumed(rectangle(8, 8, 4.), loading, options, from), std::invalid_argument);
    Options cosserat = options;
    cosserat.law     = LawKind::cosserat_mohr_coulomb;
    EXPECT_THROW((void)resumed(rectangle(8, 8, 2.), loading, cosserat, from), std::invalid_argument) << "other values of a cell";
  }
} // namespace
