// diptych: a checkpoint keeps every bit, and a loading resumed from it gives the same bits
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tests/discrete/panel/checkpoint_examples.h"

namespace
{
  // A loading, with a checkpoint before each of its steps.
  struct CheckpointedRun : Course
  {
    std::vector<Checkpoint> before;
  };

  CheckpointedRun run_with_checkpoints(const SampleOptions &sample,
                                       const Loading       &loading,
                                       const Options       &options,
                                       const Checkpoint    *resume = nullptr)
  {
    CheckpointedRun course;
    Panel          *running = nullptr;
    Hooks           hooks;
    hooks.on_row      = [&](const HistoryRow &row) { course.rows.push_back(row); };
    hooks.before_step = [&] { course.before.push_back(running->checkpoint()); };
    Panel panel(sample, loading, options, hooks);
    running = &panel;
    if (resume)
      panel.resume(*resume);
    course.report = run_to_end(panel, int(loading.stages.size()), course.snapshots, resume != nullptr);
    return course;
  }

  // Resumed before step k (counted from 0) through a file, the loading ends with the same rows and snapshots.
  void expect_same_from(const SampleOptions       &sample,
                        const Loading             &loading,
                        const Options             &options,
                        const std::vector<size_t> &ks)
  {
    const CheckpointedRun whole = run_with_checkpoints(sample, loading, options);
    ASSERT_EQ(whole.report.status, Status::finished) << whole.report.message;
    ASSERT_EQ(whole.snapshots.size(), loading.stages.size() + 1);
    ASSERT_EQ(whole.rows.size(), whole.before.size());
    for (const std::size_t k : ks)
      {
        SCOPED_TRACE("resumed before step " + std::to_string(k) + " of " + std::to_string(whole.rows.size()));
        ASSERT_LT(k, whole.rows.size());
        const std::vector<HistoryRow> rest(whole.rows.begin() + k, whole.rows.end());
        const StoredCheckpoint        kept  = written_and_read({whole.before[k], long(k), ""});
        const CheckpointedRun         again = run_with_checkpoints(sample, loading, options, &kept.panel);
        ASSERT_EQ(again.report.status, Status::finished) << again.report.message;
        EXPECT_TRUE(bits(again.rows) == bits(rest));
        const std::size_t done = kept.panel.stage + 1; // snapshots written before the checkpoint
        ASSERT_EQ(again.snapshots.size() + done, whole.snapshots.size());
        for (std::size_t s = 0; s < again.snapshots.size(); ++s)
          EXPECT_TRUE(bits(again.snapshots[s]) == bits(whole.snapshots[done + s])) << "stage " << done + s;
        EXPECT_EQ(again.report.step, whole.report.step);
        EXPECT_EQ(again.report.steps, whole.report.steps);
        EXPECT_EQ(again.report.sweeps, whole.report.sweeps);
        EXPECT_EQ(again.report.snapshots_sampled, whole.report.snapshots_sampled);
      }
  }

  // Two stages of ten steps. The second one differs from the first by rounding.
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

  // Before the first step, within a stage, before its last step, and before the first step of the next stage.
  const std::vector<std::size_t> everywhere = {0, 1, 5, 9, 10, 11, 19};

  TEST(Resume, FreeSidesWithWindowsAndSampledSnapshots)
  {
    expect_same_from(small_sample(150), two_stages(), sampled_options(), everywhere);
  }

  TEST(Resume, SidesUnderPressureAndMoving)
  {
    for (const Lateral lateral : {Lateral::rigid_walls, Lateral::periodic})
      {
        Options options              = sampled_options();
        options.lateral.lateral      = lateral;
        options.law.rolling_friction = 0.1;
        expect_same_from(small_sample(150), two_stages(), options, everywhere);
        options.lateral.side_motion   = SideMotion::velocity;
        options.lateral.side_velocity = 0.01;
        expect_same_from(small_sample(150), two_stages(), options, {10, 14});
      }
  }

  TEST(Resume, PlaneShearWithAFreePlaten)
  {
    Options options         = sampled_options();
    options.lateral.lateral = Lateral::periodic;
    Loading loading         = two_stages();
    loading.mode            = LoadingMode::plane_shear;
    expect_same_from(small_sample(150), loading, options, {0, 7, 10, 13});
  }

  // The step of the second stage follows from the previous row. The checkpoint must contain that row although no row is due.
  TEST(Resume, AutomaticStepAndRowsFarApart)
  {
    Options options = quick_options();
    options.stepping.step.reset();
    expect_same_from(small_sample(150), {1, 1e-3, 1, {0.004, 0.01}}, options, {0, 3, 5, 8});
  }

  TEST(Resume, CellUnderShearAndBack)
  {
    Options options         = sampled_options();
    options.lateral.lateral = Lateral::cell;
    Loading loading         = two_stages();
    loading.mode            = LoadingMode::path;
    loading.path.form << 0, 0, 1, 0, 1, 0, 1, 0, 0; // 2 exy, syy, exx
    loading.path.is_stress = {false, true, false};
    loading.path.values    = {{0, 1, 0}, {1e-3, 1, 0}, {0, 1, 0}};
    loading.path.progress  = {0, 1, 2};
    loading.stages         = {1, 2};
    expect_same_from(small_sample(150), loading, options, everywhere);
  }

  TEST(Resume, WallsThatFollowATable)
  {
    Options options            = sampled_options();
    options.lateral.lateral    = Lateral::rigid_walls;
    options.drives.right_x     = "force -20";
    options.drives.lower_x     = "velocity 0.01";
    options.stepping.gravity_y = -0.01;
    Loading loading            = two_stages();
    loading.mode               = LoadingMode::time;
    loading.stages             = {1, 2};
    expect_same_from(small_sample(150), loading, options, {0, 4, 10, 15});
  }

  Options springs()
  {
    Options options                 = quick_options();
    options.method.method           = Method::penalty;
    options.method.history_interval = 1;
    return options;
  }

  Loading fast(const std::vector<double> &stages)
  {
    Loading loading;
    loading.inertial_number = 0.05;
    loading.stages          = stages;
    return loading;
  }

  // The impulses hold the sliding history of springs. Step lengths that differ by rounding must not change it.
  TEST(Resume, SpringsInTheMiddleOfAStage)
  {
    const Loading     loading = fast({0.001, 0.002, 0.003});
    const std::size_t n       = run_with_checkpoints(small_sample(80), loading, springs()).rows.size();
    expect_same_from(small_sample(80), loading, springs(), {0, 2, n / 2, n - 1});
    Options implicit       = quick_options();
    implicit.method.method = Method::compliant;
    expect_same_from(small_sample(80), two_stages(), implicit, {0, 4, 10});
  }

  // Stages of 0.005, 0.01 - 0.005, ... are equal except for rounding, and so are their steps.
  TEST(Resume, SpringsAtTheBeginningOfAStage)
  {
    Loading loading = fast({});
    for (int k = 1; k <= 8; ++k)
      loading.stages.push_back(k * 0.005);
    const CheckpointedRun    whole = run_with_checkpoints(small_sample(80), loading, springs());
    std::vector<std::size_t> first_steps;
    for (std::size_t k = 1; k < whole.before.size(); ++k)
      if (whole.before[k].stage > whole.before[k - 1].stage)
        first_steps.push_back(k);
    ASSERT_EQ(first_steps.size(), 7u);
    expect_same_from(small_sample(80), loading, springs(), first_steps);
  }

  // A spring pulls with kt x stretch, whatever the length of the next step. A stage of 0.7 steps is taken in one step of 0.7
  // times the length. The shear force on the platen must continue, apart from the change in one step, and not be scaled by 0.7.
  TEST(Penalty, SpringsPersistIfTheStepChanges)
  {
    Options options               = springs();
    options.penalty.step_fraction = 0.05;
    const CheckpointedRun one     = run_with_checkpoints(small_sample(80), fast({0.001}), options);
    const double          second  = 0.001 + 0.7 * one.report.step * 0.05; // the strain of 0.7 steps
    const CheckpointedRun change  = run_with_checkpoints(small_sample(80), fast({0.001, second}), options);
    ASSERT_EQ(change.rows.size(), one.rows.size() + 1);
    ASSERT_NEAR(change.report.step / one.report.step, 0.7, 1e-9);
    const double before = one.rows.back().upper_force.x(), after = change.rows.back().upper_force.x();
    EXPECT_NEAR(after / before, 1, 0.1);
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

  // Before the first step there are no rows, no impulses and no window. Without a cell there is none after reading.
  TEST(Checkpoint, KeepsEmptyListsEmpty)
  {
    StoredCheckpoint before;
    before.panel.state = disc_on_floor({0, 0});
    before.panel.state.walls.push_back({{0, 1}, {0, -1}});
    before.panel.reference.position = before.panel.state.grains.position;
    before.panel.reference.height = before.panel.reference.area = 1;
    const StoredCheckpoint after                                = written_and_read(before);
    EXPECT_EQ(bits(before.panel), bits(after.panel));
    EXPECT_FALSE(after.panel.state.width());
    EXPECT_EQ(after.n_rows, 0);
    EXPECT_EQ(after.scene, "");
  }

  // A valid file with right checksums, whose contents no loading can produce.
  TEST(Checkpoint, StatesThatNoLoadingProducesAreRefused)
  {
    const auto refused = [](const std::string &word, const std::function<void(Checkpoint &)> &change) {
      const Folder     folder;
      StoredCheckpoint checkpoint = random_checkpoint();
      change(checkpoint.panel);
      write_checkpoint(folder / "a.h5", checkpoint);
      expect_refused({folder / "a.h5", word}, [&] { (void)read_checkpoint(folder / "a.h5"); });
    };
    for (const double step : {0., -1., std::numeric_limits<double>::quiet_NaN()})
      refused("step", [&](Checkpoint &p) { p.step = step; });
    refused("time", [](Checkpoint &p) { p.state.time = -5; });
    refused("steps_left", [](Checkpoint &p) { p.steps_left = -1; });
    refused("interval", [](Checkpoint &p) { p.interval = 0; });
    refused("reference_height", [](Checkpoint &p) { p.reference.height = 0; });
    refused("walls", [](Checkpoint &p) { p.state.walls[2].normal.setZero(); });
    refused("walls", [](Checkpoint &p) { std::swap(p.state.walls[0].point, p.state.walls[1].point); });
    refused("grains", [](Checkpoint &p) { p.state.grains.radius[4] = 0; });
  }

  TEST(Checkpoint, AFileThatIsNotACheckpointIsNamed)
  {
    const Folder      folder;
    const std::string path         = folder / "a.h5";
    const auto        expect_named = [&] { expect_refused({path}, [&] { (void)read_checkpoint(path); }); };
    expect_named(); // missing file
    std::ofstream(path) << "no HDF5";
    expect_named();
    write_checkpoint(path, random_checkpoint());
    std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
    expect_named();
  }
} // namespace
