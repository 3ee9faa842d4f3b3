// diptych: what is written can be read back
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include <unistd.h>

#include "discrete/output.h"
#include "tests/discrete/small_scenes.h"

namespace
{
  using namespace diptych::tests;

  std::string temporary_path(const std::string &name)
  {
    return (std::filesystem::path(testing::TempDir()) / (name + std::to_string(::getpid()))).string();
  }

  std::vector<Snapshot> short_run()
  {
    std::vector<Snapshot> snapshots;
    Callbacks             callbacks;
    callbacks.on_stage  = [&](const Snapshot &s) { snapshots.push_back(s); };
    const Report report = run(small_sample(150), short_loading(), quick_options(), callbacks);
    EXPECT_EQ(report.status, Status::finished) << report.message;
    return snapshots;
  }

  TEST(Output, SnapshotsSurviveTheFile)
  {
    const std::vector<Snapshot> written = short_run();
    const std::string           path    = temporary_path("snapshots");
    write_snapshots(path, written);
    const std::vector<Snapshot> read = read_snapshots(path + ".h5");
    ASSERT_EQ(read.size(), written.size());
    for (std::size_t k = 0; k < read.size(); ++k)
      {
        const Snapshot &a = written[k], &b = read[k];
        EXPECT_EQ(a.axial_strain, b.axial_strain);
        EXPECT_EQ(a.position, b.position);
        EXPECT_EQ(a.mean_internal_moment, b.mean_internal_moment);
        EXPECT_EQ(a.rattler, b.rattler);
        EXPECT_EQ(a.status, b.status);
        EXPECT_EQ(a.outline.left, b.outline.left);
        EXPECT_EQ(a.upper_platen_displacement, b.upper_platen_displacement);
        ASSERT_EQ(a.window_forces.size(), b.window_forces.size());
        for (std::size_t c = 0; c < a.window_forces.size(); ++c)
          EXPECT_EQ(a.window_forces[c].force, b.window_forces[c].force);
      }
    EXPECT_FALSE(std::filesystem::exists(path + ".h5.part"));
    std::filesystem::remove(path + ".h5"), std::filesystem::remove(path + ".xdmf");
  }

  TEST(Output, ATruncatedFileIsAnErrorThatNamesIt)
  {
    const std::string path = temporary_path("truncated") + ".h5";
    std::ofstream(path) << "\x89HDF\r\n";
    try
      {
        read_snapshots(path);
        FAIL() << "no error";
      }
    catch (const std::runtime_error &error)
      {
        EXPECT_NE(std::string(error.what()).find(path), std::string::npos) << error.what();
      }
    std::filesystem::remove(path);
  }
} // namespace
