// diptych: a checkpoint keeps every bit of a loading, and wrong files are refused
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tests/discrete/panel/checkpoint_examples.h"

namespace
{
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
