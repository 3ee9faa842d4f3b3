// diptych: snapshots read back as they were written, and impossible ones are refused
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hdf5.h>

#include "discrete/panel/snapshot_file.h"
#include "discrete/snapshot_fields.h"
#include "tests/discrete/panel/checkpoint_examples.h"

namespace
{
  std::vector<Snapshot> short_run()
  {
    static const Course course = loaded(small_sample(150), short_loading(), quick_options());
    EXPECT_EQ(course.report.status, Status::finished) << course.report.message;
    return course.snapshots;
  }

  // Snapshots in a file.
  struct Output : testing::Test
  {
    const Folder      folder;
    const std::string stem = folder / "run", path = stem + ".h5";

    // Snapshots that no panel can produce are written unchecked but refused on reading, with file, stage and entry.
    void expect_entry_refused(const std::string &entry, const std::function<void(Snapshot &)> &change) const
    {
      std::vector<Snapshot> snapshots = short_run();
      change(snapshots[1]);
      write_snapshots(stem, snapshots);
      expect_refused({path + ": stage_0001/" + entry}, [&] { (void)read_snapshots(path); });
    }
  };

  TEST_F(Output, SnapshotsSurviveTheFile)
  {
    const std::vector<Snapshot> written = short_run();
    write_snapshots(stem, written);
    const std::vector<Snapshot> read = read_snapshots(path);
    ASSERT_EQ(read.size(), written.size());
    for (std::size_t k = 0; k < read.size(); ++k)
      EXPECT_TRUE(bits(written[k]) == bits(read[k])) << "stage " << k;
    EXPECT_FALSE(std::filesystem::exists(path + ".part"));
  }

  // Some files do not contain the dissipation of pairs. The entries are then missing, not zero.
  TEST_F(Output, AFileWithoutDissipationLeavesItEmpty)
  {
    const std::vector<Snapshot> written = short_run();
    write_snapshots(stem, written);
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    EXPECT_GE(H5Ldelete(file, "stage_0001/window/dissipation", H5P_DEFAULT), 0);
    H5Fclose(file);
    const std::vector<Snapshot> read = read_snapshots(path);
    EXPECT_EQ(read[1].window_forces.size(), written[1].window_forces.size());
    EXPECT_TRUE(read[1].window_dissipation.empty());
    EXPECT_EQ(read[2].window_dissipation, written[2].window_dissipation);
  }

  TEST_F(Output, AttributesAreFiniteUnlessTheirMeaningSaysOtherwise)
  {
    Snapshot names;
    visit_attributes(names, [&](const std::string &wanted, const auto &member, const char *, const Meaning &meaning) {
      if constexpr (std::is_same_v<std::decay_t<decltype(member)>, double>)
        if (wanted != "step" && !meaning.may_be_nan)
          for (const double bad : {double(NAN), double(INFINITY)})
            expect_entry_refused(wanted, [&](Snapshot &s) {
              visit_attributes(s, [&](const std::string &name, auto &value, const char *, const char *) {
                if constexpr (std::is_same_v<std::decay_t<decltype(value)>, double>)
                  value = name == wanted ? bad : value;
              });
            });
    });
    expect_entry_refused("mean_diameter", [](Snapshot &s) { s.mean_diameter = 0; });
    std::vector<Snapshot> accurate = short_run();
    accurate[1].stress_error       = INFINITY;
    write_snapshots(stem, accurate);
    EXPECT_TRUE(std::isinf(read_snapshots(path)[1].stress_error));
  }

  // A frame of another code has no step, and many values are missing.
  TEST_F(Output, ValuesMissingInAnotherCodeStayNan)
  {
    std::vector<Snapshot> snapshots = short_run();
    for (Snapshot &s : snapshots)
      s.step = s.residual = s.time = s.lower_platen_force.x() = NAN;
    write_snapshots(stem, snapshots);
    EXPECT_TRUE(std::isnan(read_snapshots(path)[1].step));
    expect_entry_refused("upper_y", [](Snapshot &s) { s.step = s.upper_y = NAN; });
  }

  // Valid files, with right checksums, of impossible grains and contacts.
  TEST_F(Output, ImpossibleGrainsContactsAndOutlinesAreRefused)
  {
    expect_entry_refused("grains", [](Snapshot &s) { s.radius[0] = 0; });
    expect_entry_refused("grains", [](Snapshot &s) { s.mass[0] = -1; });
    expect_entry_refused("mean_diameter or area", [](Snapshot &s) { s.area = -s.area; });
    expect_entry_refused("window/normal", [](Snapshot &s) { s.window_forces[0].normal.setZero(); });
    expect_entry_refused("contacts/body", [](Snapshot &s) { s.contacts[0].j = s.contacts[0].i; });
    expect_entry_refused("outline", [](Snapshot &s) { std::swap(s.outline.left, s.outline.right); });
    expect_entry_refused("outline/right", [](Snapshot &s) { s.outline.right[0].x() = 1 << 30; });
    expect_entry_refused("outline/left", [](Snapshot &s) { s.outline.left[0].y() = -1e6; });
  }

  // An array from another program has no checksum.
  TEST_F(Output, AnArrayWithoutItsChecksumIsRefused)
  {
    write_snapshots(stem, short_run());
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), stage = H5Gopen2(file, "stage_0001/grains", H5P_DEFAULT);
    const hsize_t n = short_run()[1].radius.size();
    EXPECT_GE(H5Ldelete(stage, "radius", H5P_DEFAULT), 0);
    const hid_t space = H5Screate_simple(1, &n, nullptr),
                set   = H5Dcreate2(stage, "radius", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    EXPECT_GE(H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, std::vector<double>(n, 0.5).data()), 0);
    H5Dclose(set), H5Sclose(space), H5Gclose(stage), H5Fclose(file);
    EXPECT_THROW(read_snapshots(path), std::invalid_argument);
    EXPECT_EQ(Hdf5Reader(path).read("stage_0001/grains/radius"), std::vector<double>(n, 0.5));
  }

  TEST_F(Output, ATruncatedFileIsAnErrorThatNamesIt)
  {
    write_text(path, "\x89HDF\r\n");
    expect_refused({path}, [&] { read_snapshots(path); });
  }
} // namespace
