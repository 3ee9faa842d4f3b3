// diptych: snapshots read back as they were written, and impossible ones are refused
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <type_traits>

#include <gtest/gtest.h>
#include <hdf5.h>

#include <unistd.h>

#include "discrete/panel/snapshot_file.h"
#include "discrete/snapshot_fields.h"
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
    static const Course course = loaded(small_sample(150), short_loading(), quick_options());
    EXPECT_EQ(course.report.status, Status::finished) << course.report.message;
    return course.snapshots;
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
        EXPECT_EQ(a.window_dissipation, b.window_dissipation);
        EXPECT_EQ(a.window_impact_dissipation, b.window_impact_dissipation);
      }
    EXPECT_FALSE(std::filesystem::exists(path + ".h5.part"));
    std::filesystem::remove(path + ".h5"), std::filesystem::remove(path + ".xdmf");
  }

  // Some files do not contain the dissipation of pairs. The entries are then missing, not zero.
  TEST(Output, AFileWithoutDissipationLeavesItEmpty)
  {
    const std::vector<Snapshot> written = short_run();
    const std::string           path    = temporary_path("earlier");
    write_snapshots(path, written);
    const hid_t file = H5Fopen((path + ".h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    EXPECT_GE(H5Ldelete(file, "stage_0001/window/dissipation", H5P_DEFAULT), 0);
    H5Fclose(file);
    const std::vector<Snapshot> read = read_snapshots(path + ".h5");
    EXPECT_EQ(read[1].window_forces.size(), written[1].window_forces.size());
    EXPECT_TRUE(read[1].window_dissipation.empty());
    EXPECT_EQ(read[2].window_dissipation, written[2].window_dissipation);
    std::filesystem::remove(path + ".h5"), std::filesystem::remove(path + ".xdmf");
  }

  // ParaView finds the numbers through the .xdmf file: points, and one value for each.
  TEST(Output, XdmfShowsTheDissipationAtThePairsOfItsWindow)
  {
    const std::vector<Snapshot> written = short_run();
    const std::string           path    = temporary_path("shown");
    write_snapshots(path, written);
    std::ifstream     in(path + ".xdmf");
    const std::string xdmf{std::istreambuf_iterator<char>(in), {}};
    for (const auto &[extents, array] : {std::pair{"", "dissipation<"}, std::pair{" 3", "force<"}, std::pair{" 3", "point<"}})
      {
        const std::string item = "Dimensions=\"" + std::to_string(written[2].window_forces.size()) + extents + "\">" +
                                 path.substr(path.find_last_of('/') + 1) + ".h5:/stage_0002/window/" + array;
        EXPECT_NE(xdmf.find(item), std::string::npos) << item;
      }
    std::filesystem::remove(path + ".h5"), std::filesystem::remove(path + ".xdmf");
  }

  // Snapshots that no panel can produce are written unchecked but refused on reading, with file, stage and entry.
  void expect_refused(const std::string &entry, const std::function<void(Snapshot &)> &change)
  {
    std::vector<Snapshot> snapshots = short_run();
    change(snapshots[1]);
    const std::string path = temporary_path("changed");
    write_snapshots(path, snapshots);
    try
      {
        (void)read_snapshots(path + ".h5");
        ADD_FAILURE() << entry << " was taken";
      }
    catch (const std::invalid_argument &error)
      {
        EXPECT_NE(std::string(error.what()).find(path + ".h5: stage_0001/" + entry), std::string::npos) << error.what();
      }
    std::filesystem::remove(path + ".h5"), std::filesystem::remove(path + ".xdmf");
  }

  TEST(Output, AttributesAreFiniteUnlessTheirMeaningSaysOtherwise)
  {
    Snapshot names;
    visit_attributes(names, [&](const std::string &wanted, const auto &member, const char *, const Meaning &meaning) {
      if constexpr (std::is_same_v<std::decay_t<decltype(member)>, double>)
        if (wanted != "step" && !meaning.may_be_nan)
          for (const double bad : {double(NAN), double(INFINITY)})
            expect_refused(wanted, [&](Snapshot &s) {
              visit_attributes(s, [&](const std::string &name, auto &value, const char *, const char *) {
                if constexpr (std::is_same_v<std::decay_t<decltype(value)>, double>)
                  value = name == wanted ? bad : value;
              });
            });
    });
    expect_refused("mean_diameter", [](Snapshot &s) { s.mean_diameter = 0; });
    std::vector<Snapshot> accurate = short_run();
    accurate[1].stress_error       = INFINITY;
    const std::string path         = temporary_path("unknown");
    write_snapshots(path, accurate);
    EXPECT_TRUE(std::isinf(read_snapshots(path + ".h5")[1].stress_error));
    std::filesystem::remove(path + ".h5"), std::filesystem::remove(path + ".xdmf");
  }

  // A frame of another code has no step, and many values are missing.
  TEST(Output, ValuesMissingInAnotherCodeStayNan)
  {
    std::vector<Snapshot> snapshots = short_run();
    for (Snapshot &s : snapshots)
      s.step = s.residual = s.time = s.lower_platen_force.x() = NAN;
    const std::string path = temporary_path("missing_values");
    write_snapshots(path, snapshots);
    EXPECT_TRUE(std::isnan(read_snapshots(path + ".h5")[1].step));
    std::filesystem::remove(path + ".h5"), std::filesystem::remove(path + ".xdmf");
    expect_refused("upper_y", [](Snapshot &s) { s.step = s.upper_y = NAN; });
  }

  TEST(Output, AnOutlineFarFromTheGrainsIsRefused)
  {
    expect_refused("outline/right", [](Snapshot &s) { s.outline.right[0].x() = 1 << 30; });
    expect_refused("outline/left", [](Snapshot &s) { s.outline.left[0].y() = -1e6; });
  }

  // Valid files, with right checksums, of impossible grains and contacts.
  TEST(Output, ImpossibleGrainsAndContactsAreRefused)
  {
    const auto refused = [](const std::string &word, const std::function<void(Snapshot &)> &change) {
      std::vector<Snapshot> written = short_run();
      const std::string     path    = temporary_path("impossible");
      change(written[1]);
      write_snapshots(path, written);
      try
        {
          (void)read_snapshots(path + ".h5");
          ADD_FAILURE() << word << " was taken";
        }
      catch (const std::invalid_argument &error)
        {
          EXPECT_NE(std::string(error.what()).find("stage_0001"), std::string::npos) << error.what();
          EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
        }
      std::filesystem::remove(path + ".h5"), std::filesystem::remove(path + ".xdmf");
    };
    refused("radius", [](Snapshot &s) { s.radius[0] = 0; });
    refused("mass", [](Snapshot &s) { s.mass[0] = -1; });
    refused("area", [](Snapshot &s) { s.area = -s.area; });
    refused("window/normal", [](Snapshot &s) { s.window_forces[0].normal.setZero(); });
    refused("contacts/body", [](Snapshot &s) { s.contacts[0].j = s.contacts[0].i; });
    refused("outline", [](Snapshot &s) { std::swap(s.outline.left, s.outline.right); });
  }

  // An array from another program has no checksum.
  TEST(Output, AnArrayWithoutItsChecksumIsRefused)
  {
    const std::string path = temporary_path("unchecked");
    write_snapshots(path, short_run());
    const hid_t file  = H5Fopen((path + ".h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT),
                stage = H5Gopen2(file, "stage_0001/grains", H5P_DEFAULT);
    const hsize_t n   = short_run()[1].radius.size();
    EXPECT_GE(H5Ldelete(stage, "radius", H5P_DEFAULT), 0);
    const hid_t space = H5Screate_simple(1, &n, nullptr),
                set   = H5Dcreate2(stage, "radius", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    EXPECT_GE(H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, std::vector<double>(n, 0.5).data()), 0);
    H5Dclose(set), H5Sclose(space), H5Gclose(stage), H5Fclose(file);
    EXPECT_THROW(read_snapshots(path + ".h5"), std::invalid_argument);
    EXPECT_EQ(Hdf5Reader(path + ".h5").read("stage_0001/grains/radius"), std::vector<double>(n, 0.5));
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
    catch (const std::invalid_argument &error)
      {
        EXPECT_NE(std::string(error.what()).find(path), std::string::npos) << error.what();
      }
    std::filesystem::remove(path);
  }
} // namespace
