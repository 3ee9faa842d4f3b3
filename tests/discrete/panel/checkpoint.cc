// diptych: a loading taken up from a checkpoint goes on with the same bits
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

#include <unistd.h>

#include <gtest/gtest.h>

#include "discrete/panel/checkpoint.h"
#include "tests/discrete/small_scenes.h"

namespace
{
  using namespace diptych::tests;

  // Every number of an object in turn, so that two of them can be compared bit by bit, NaN included.
  struct Bits
  {
    std::vector<std::uint64_t> words = {};

    void operator()(const double value)
    {
      std::uint64_t word = 0;
      std::memcpy(&word, &value, sizeof word);
      words.push_back(word);
    }
    void operator()(const Eigen::Vector2d &v) { (*this)(v.x()), (*this)(v.y()); }
    void operator()(const Eigen::Matrix2d &m) { (*this)(Eigen::Vector2d(m.row(0))), (*this)(Eigen::Vector2d(m.row(1))); }
    void operator()(const ContactForce &c)
    {
      (*this)(c.i), (*this)(c.j), (*this)(c.point), (*this)(c.normal), (*this)(c.force), (*this)(c.shift);
    }
    void operator()(const ContactStatus &status) { (*this)(double(status)); }
    void operator()(const PairImpulse &r) { (*this)(r.i), (*this)(r.j), (*this)(r.normal), (*this)(r.tangential); }
    void operator()(const WindowForces::PairSum &s)
    {
      (*this)(s.i), (*this)(s.j), (*this)(s.dissipation), (*this)(s.impact), (*this)(s.impulse);
    }
    void operator()(const Wall &w)
    {
      (*this)(w.point), (*this)(w.normal), (*this)(w.velocity), (*this)(w.mass), (*this)(double(w.kind));
    }
    void operator()(const HistoryRow &row)
    {
      visit_columns(row, [&](const char *, const auto &value, const char *, const char *) { (*this)(double(value)); });
    }
    template <class T> void operator()(const std::vector<T> &values)
    {
      (*this)(double(values.size()));
      for (const T &value : values)
        (*this)(value);
    }
    template <class First, class Second, class... Rest>
    void operator()(const First &first, const Second &second, const Rest &...rest)
    {
      (*this)(first);
      (*this)(second, rest...);
    }
  };

  std::vector<std::uint64_t> bits(const Snapshot &s)
  {
    Bits b;
    b(double(s.walk), s.progress, s.axial_strain, s.time, s.step, s.residual, s.mean_diameter, s.shear_strain, s.stress_error,
      s.stress_change, s.error_over_residual);
    b(s.position, s.displacement, s.velocity, s.rotation, s.spin, s.radius, s.mass, s.internal_moment, s.mean_internal_moment);
    b(s.mean_spin_term, s.rattler, s.fixed, s.contacts, s.gap, s.status, s.applied_force, s.window_forces, s.window_time,
      s.window_dissipation, s.window_impact_dissipation);
    b(s.lower_y, s.upper_y, s.upper_platen_displacement, s.lower_platen_force, s.upper_platen_force, s.left_x, s.right_x);
    b(s.cell_width, s.outline.left, s.outline.right, s.area);
    return b.words;
  }

  std::vector<std::uint64_t> bits(const std::vector<HistoryRow> &rows)
  {
    Bits b;
    b(rows);
    return b.words;
  }

  // All that a checkpoint promises to keep; drives follow from the scene.
  std::vector<std::uint64_t> bits(const Checkpoint &p)
  {
    Bits          b;
    const Grains &g = p.state.grains;
    b(g.position, g.velocity, g.rotation, g.spin, g.radius, g.mass, g.fixed);
    b(p.state.walls, p.state.impulses, p.state.time, double(p.state.cell.has_value()));
    if (p.state.cell)
      b(p.state.cell->width, p.state.cell->velocity, p.state.cell->mass);
    const Reference &r = p.reference;
    b(r.position, r.platen, r.height, r.area, r.grain_area, r.kinetic_energy, r.platen_kinetic_energy, r.strain_rate,
      r.mean_density);
    b(p.row, p.window.sums, p.window.spin, p.window.time, p.stage, double(p.steps_left), p.step, double(p.interval));
    const Report &q = p.report;
    b(q.progress, q.axial_strain, q.shear_strain, double(q.preparation.quiet), q.preparation.steps, q.preparation.residual,
      q.preparation.unbalanced_force, q.preparation.solid_fraction, q.preparation.soft_overlap, q.preparation.friction);
    b(double(q.steps), double(q.sweeps), double(q.updates), q.preparation_cpu_s, q.loading_cpu_s, q.solver_cpu_s,
      q.initial_height, q.platen_speed, q.error_over_residual, q.reference_residual, q.reference_error, q.estimated_error);
    b(q.snapshots_sampled, q.snapshots_accurate);
    return b.words;
  }

  // Values over many decades of both signs.
  struct Dice
  {
    std::mt19937_64 random{7};

    double operator()()
    {
      const double mantissa = double(std::int64_t(random())) * 0x1.0p-63;
      return std::ldexp(mantissa, int(random() % 200) - 100);
    }
    int             whole() { return int(random() % 1000000); }
    Eigen::Vector2d vector() { return {(*this)(), (*this)()}; }
  };

  HistoryRow random_row(Dice &dice)
  {
    HistoryRow row;
    visit_columns(row, [&](const char *, auto &value, const char *, const char *) {
      using Value = std::decay_t<decltype(value)>;
      if constexpr (std::is_same_v<Value, double>)
        value = dice();
      else if constexpr (std::is_enum_v<Value>)
        value = Value(dice.whole() % 3);
      else
        value = dice.whole();
    });
    return row;
  }

  void fill_state(Dice &dice, State &state)
  {
    for (int k = 0; k < 9; ++k)
      {
        add_grain(state.grains, dice.vector(), dice(), 1.);
        state.grains.velocity.back() = dice.vector();
        state.grains.rotation.back() = dice(), state.grains.spin.back() = dice(), state.grains.mass.back() = dice();
        state.grains.fixed.back() = k % 3 == 0;
      }
    for (int w = 0; w < 4; ++w)
      {
        Wall wall{dice.vector(), dice.vector(), dice.vector(), {}, {}, dice()};
        wall.kind = w < 2 ? WallKind::platen : WallKind::side;
        state.walls.push_back(wall);
      }
    state.cell = PeriodicCell{dice(), dice(), {}, dice()};
    for (int k = 0; k < 5; ++k)
      state.impulses.push_back({k, k + 3, dice(), dice()});
    state.time = dice();
  }

  void fill_report(Dice &dice, Report &q)
  {
    q.progress = dice(), q.axial_strain = dice(), q.shear_strain = dice(), q.steps = dice.whole(), q.sweeps = 123456789012345,
    q.updates           = 9007199254740991; // 2^53 - 1
    q.preparation       = {true, dice.whole(), dice(), dice(), dice(), dice(), dice()};
    q.preparation_cpu_s = dice(), q.loading_cpu_s = dice(), q.solver_cpu_s = dice(), q.initial_height = dice();
    q.platen_speed = dice(), q.reference_error = dice(), q.snapshots_sampled = 12, q.snapshots_accurate = 7;
    q.estimated_error = std::numeric_limits<double>::infinity(); // error_over_residual and reference_residual stay NaN
    q.step_bound      = "forces";
  }

  StoredCheckpoint random_checkpoint()
  {
    Dice             dice;
    StoredCheckpoint checkpoint;
    Checkpoint      &p = checkpoint.panel;
    fill_state(dice, p.state);
    fill_report(dice, p.report);
    for (std::size_t i = 0; i < p.state.grains.size(); ++i)
      p.reference.position.push_back(dice.vector()), p.window.spin.push_back(dice());
    p.reference.platen = dice.vector(), p.reference.height = dice(), p.reference.area = dice();
    p.reference.grain_area = dice(), p.reference.kinetic_energy = dice(), p.reference.platen_kinetic_energy = dice();
    p.reference.strain_rate = dice(), p.reference.mean_density = dice();
    for (int k = 0; k < 6; ++k)
      p.window.sums.push_back({k, k + 1, dice(), dice(), dice.vector()});
    p.window.time = dice(), p.stage = 3, p.steps_left = 77, p.step = dice(), p.interval = 5;
    p.row                 = random_row(dice);
    p.row.energy_residual = std::numeric_limits<double>::quiet_NaN();
    checkpoint.n_rows     = 123456789;
    checkpoint.scene      = "sample/seed=1\nsample/file=two lines\n";
    return checkpoint;
  }

  // A file name that lives as long as the test.
  struct CheckpointFile
  {
    std::string path = (std::filesystem::path(testing::TempDir()) / ("checkpoint" + std::to_string(::getpid()) + ".h5")).string();

    ~CheckpointFile() { std::filesystem::remove(path); }
  };

  StoredCheckpoint written_and_read(const StoredCheckpoint &checkpoint)
  {
    const CheckpointFile file;
    write_checkpoint(file.path, checkpoint);
    EXPECT_FALSE(std::filesystem::exists(file.path + ".part"));
    return read_checkpoint(file.path);
  }

  TEST(Checkpoint, KeepsEveryBit)
  {
    const StoredCheckpoint before = random_checkpoint(), after = written_and_read(before);
    EXPECT_EQ(bits(before.panel), bits(after.panel));
    EXPECT_EQ(before.n_rows, after.n_rows);
    EXPECT_EQ(before.scene, after.scene);
    EXPECT_EQ(after.panel.report.step_bound, "forces");
    EXPECT_EQ(after.panel.report.status, Status::finished);
  }

  // Before the first step there are no rows, no impulses and no window; without a cell there is none afterwards.
  TEST(Checkpoint, KeepsWhatIsEmptyEmpty)
  {
    StoredCheckpoint before;
    before.panel.state = disc_on_floor({0, 0});
    before.panel.state.walls.push_back({{0, 1}, {0, -1}});
    before.panel.reference.position = before.panel.state.grains.position;
    const StoredCheckpoint after    = written_and_read(before);
    EXPECT_EQ(bits(before.panel), bits(after.panel));
    EXPECT_FALSE(after.panel.state.cell);
    EXPECT_EQ(after.n_rows, 0);
    EXPECT_EQ(after.scene, "");
  }

  TEST(Checkpoint, AFileThatIsNoneIsNamed)
  {
    const CheckpointFile file;
    const auto           expect_named = [&] {
      try
        {
          (void)read_checkpoint(file.path);
          FAIL() << "no error";
        }
      catch (const std::invalid_argument &error)
        {
          EXPECT_NE(std::string(error.what()).find(file.path), std::string::npos) << error.what();
        }
    };
    expect_named(); // missing
    std::ofstream(file.path) << "no HDF5";
    expect_named();
    write_checkpoint(file.path, random_checkpoint());
    std::filesystem::resize_file(file.path, std::filesystem::file_size(file.path) / 2);
    expect_named();
  }

  // A loading, and what it was before each of its steps.
  struct Course
  {
    Report                  report;
    std::vector<Snapshot>   snapshots;
    std::vector<HistoryRow> rows;
    std::vector<Checkpoint> before;
  };

  Course loaded(const SampleOptions &sample, const Loading &loading, const Options &options, const Checkpoint *resume = nullptr)
  {
    Course course;
    Panel *under_way = nullptr;
    Hooks  hooks;
    hooks.on_row      = [&](const HistoryRow &row) { course.rows.push_back(row); };
    hooks.before_step = [&] { course.before.push_back(under_way->checkpoint()); };
    Panel panel(sample, loading, options, hooks);
    under_way = &panel;
    if (resume)
      panel.resume(*resume);
    course.report = walked(panel, int(loading.stages.size()), course.snapshots, resume != nullptr);
    return course;
  }

  // Taken up before step k (counted from 0) by way of a file, the loading ends with the same rows and snapshots.
  void expect_same_from(const SampleOptions       &sample,
                        const Loading             &loading,
                        const Options             &options,
                        const std::vector<size_t> &ks)
  {
    const Course whole = loaded(sample, loading, options);
    ASSERT_EQ(whole.report.status, Status::finished) << whole.report.message;
    ASSERT_EQ(whole.snapshots.size(), loading.stages.size() + 1);
    ASSERT_EQ(whole.rows.size(), whole.before.size());
    for (const std::size_t k : ks)
      {
        SCOPED_TRACE("taken up before step " + std::to_string(k) + " of " + std::to_string(whole.rows.size()));
        ASSERT_LT(k, whole.rows.size());
        const std::vector<HistoryRow> rest(whole.rows.begin() + k, whole.rows.end());
        const StoredCheckpoint        kept  = written_and_read({whole.before[k], long(k), ""});
        const Course                  again = loaded(sample, loading, options, &kept.panel);
        ASSERT_EQ(again.report.status, Status::finished) << again.report.message;
        EXPECT_TRUE(bits(again.rows) == bits(rest));
        const std::size_t done = kept.panel.stage + 1; // snapshots written before
        ASSERT_EQ(again.snapshots.size() + done, whole.snapshots.size());
        for (std::size_t s = 0; s < again.snapshots.size(); ++s)
          EXPECT_TRUE(bits(again.snapshots[s]) == bits(whole.snapshots[done + s])) << "stage " << done + s;
        EXPECT_EQ(again.report.step, whole.report.step);
        EXPECT_EQ(again.report.steps, whole.report.steps);
        EXPECT_EQ(again.report.sweeps, whole.report.sweeps);
        EXPECT_EQ(again.report.snapshots_sampled, whole.report.snapshots_sampled);
      }
  }

  // Two stages of ten steps; the second differs from the first by rounding.
  Loading two_stages()
  {
    Loading loading;
    loading.inertial_number = 1e-3;
    loading.stages          = {0.001, 0.002};
    return loading;
  }

  Options sampled_options()
  {
    Options options                      = quick_options();
    options.sampling.snapshot_max_sweeps = 200;
    options.sampling.reference_sweeps    = 400;
    return options;
  }

  // Before the first step, within a stage, before its last step, before the first of the next.
  const std::vector<std::size_t> everywhere = {0, 1, 5, 9, 10, 11, 19};

  TEST(Resume, FreeSidesWithWindowsAndSampledSnapshots)
  {
    expect_same_from(small_sample(150), two_stages(), sampled_options(), everywhere);
  }

  TEST(Resume, RigidWalls)
  {
    Options options         = sampled_options();
    options.lateral.lateral = Lateral::rigid_walls;
    expect_same_from(small_sample(150), two_stages(), options, everywhere);
    options.lateral.side_motion   = SideMotion::velocity;
    options.lateral.side_velocity = 0.01;
    expect_same_from(small_sample(150), two_stages(), options, {10, 14});
  }

  TEST(Resume, PeriodicWidthFreeAndMoving)
  {
    Options options         = sampled_options();
    options.lateral.lateral = Lateral::periodic;
    expect_same_from(small_sample(150), two_stages(), options, everywhere);
    options.lateral.side_motion   = SideMotion::velocity;
    options.lateral.side_velocity = 0.01;
    expect_same_from(small_sample(150), two_stages(), options, {10, 14});
  }

  TEST(Resume, PlaneShearWithAFreePlaten)
  {
    Options options         = sampled_options();
    options.lateral.lateral = Lateral::periodic;
    Loading loading         = two_stages();
    loading.mode            = LoadingMode::plane_shear;
    expect_same_from(small_sample(150), loading, options, {0, 7, 10, 13});
  }

  // The step of the second stage is chosen from the row before it, which the checkpoint must hold although no row is due.
  TEST(Resume, AutomaticStepAndRowsFarApart)
  {
    Options options = quick_options();
    options.time.step.reset();
    expect_same_from(small_sample(150), {1, 1e-3, 1, {0.004, 0.01}}, options, {0, 3, 5, 8});
  }

  TEST(Resume, WallsThatFollowATable)
  {
    Options options         = sampled_options();
    options.lateral.lateral = Lateral::rigid_walls;
    options.drives.right_x  = "force -20";
    options.drives.lower_x  = "velocity 0.01";
    options.time.gravity_y  = -0.01;
    Loading loading         = two_stages();
    loading.mode            = LoadingMode::time;
    loading.stages          = {1, 2};
    expect_same_from(small_sample(150), loading, options, {0, 4, 10, 15});
  }

  // Springs carry the history of sliding in the impulses: step lengths that differ by rounding must not tear them.
  TEST(Resume, SpringsInTheMiddleOfAStage)
  {
    Options options                 = quick_options();
    options.method.method           = Method::penalty;
    options.method.history_interval = 1;
    Loading loading                 = two_stages();
    loading.inertial_number         = 0.05;
    loading.stages                  = {0.001, 0.002, 0.003};
    const std::size_t n             = loaded(small_sample(80), loading, options).rows.size();
    expect_same_from(small_sample(80), loading, options, {0, 2, n / 2, n - 1});
  }

  // Stages of 0.005, 0.01 - 0.005, ...: equal but for rounding, and so are their steps.
  TEST(Resume, SpringsAtTheBeginningOfAStage)
  {
    Options options                 = quick_options();
    options.method.method           = Method::penalty;
    options.method.history_interval = 1;
    Loading loading                 = two_stages();
    loading.inertial_number         = 0.05;
    loading.stages.clear();
    for (int k = 1; k <= 8; ++k)
      loading.stages.push_back(k * 0.005);
    const Course             whole = loaded(small_sample(80), loading, options);
    std::vector<std::size_t> first_steps;
    for (std::size_t k = 1; k < whole.before.size(); ++k)
      if (whole.before[k].stage > whole.before[k - 1].stage)
        first_steps.push_back(k);
    ASSERT_EQ(first_steps.size(), 7u);
    expect_same_from(small_sample(80), loading, options, first_steps);
  }

  // A spring pulls with kt x stretch whatever the step that follows. A stage of 0.7 steps is taken in one step 0.7 times as
  // long: the shear force on the platen goes on but for what one step adds, and is not scaled by 0.7.
  TEST(Penalty, SpringsGoOnWhereTheStepChanges)
  {
    Options options                 = quick_options();
    options.method.method           = Method::penalty;
    options.method.history_interval = 1;
    options.penalty.step_fraction   = 0.05;
    Loading loading                 = two_stages();
    loading.inertial_number         = 0.05;
    loading.stages                  = {0.001};
    const Course one                = loaded(small_sample(80), loading, options);
    const double strain_of_a_step   = one.report.step * loading.inertial_number;
    loading.stages                  = {0.001, 0.001 + 0.7 * strain_of_a_step};
    const Course change             = loaded(small_sample(80), loading, options);
    ASSERT_EQ(change.rows.size(), one.rows.size() + 1);
    ASSERT_NEAR(change.report.step / one.report.step, 0.7, 1e-9);
    const double before = one.rows.back().upper_force.x(), after = change.rows.back().upper_force.x();
    EXPECT_NEAR(after / before, 1, 0.1);
  }
} // namespace
