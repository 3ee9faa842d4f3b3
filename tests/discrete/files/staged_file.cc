// diptych: a file of stages grows without touching what it holds, and any reader of HDF5 opens it at any time
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/files/staged_file.h"
#include "tests/common.h"

namespace
{
  using namespace diptych::discrete;
  using namespace diptych::tests;
  namespace fs = std::filesystem;

  struct Stages : testing::Test
  {
    const Folder      folder;
    const std::string path = folder / "panel";

    static void add(StagedFile &file, const double value)
    {
      file.add([&](Hdf5Writer &writer, const std::string &group) {
        writer.write(group + "/grains/radius", std::vector<double>(1000, value));
        writer.attribute(group, "time", value);
      });
    }

    std::vector<double> times() const
    {
      const Hdf5Reader    file(path + ".h5");
      std::vector<double> values;
      for (std::size_t k = 0; k < count_stages(file); ++k)
        {
          values.push_back(file.attribute(stage_name(k), "time"));
          EXPECT_EQ(file.read(stage_name(k) + "/grains/radius"), std::vector<double>(1000, values.back()));
        }
      return values;
    }
  };

  TEST_F(Stages, StandInOneFileAfterEveryOneOfThem)
  {
    StagedFile file(path);
    add(file, 1);
    EXPECT_EQ(times(), (std::vector<double>{1}));
    add(file, 2);
    EXPECT_EQ(times(), (std::vector<double>{1, 2}));
    file.close();
    EXPECT_EQ(times(), (std::vector<double>{1, 2}));
    EXPECT_FALSE(fs::exists(path)) << "the folder of the parts is gone";
  }

  // No byte of a written stage is touched: its part keeps its time of change and its content.
  TEST_F(Stages, WrittenOnceAreNotWrittenAgain)
  {
    StagedFile file(path);
    add(file, 1);
    const fs::path first    = path + "/stage_0000.h5";
    const auto     long_ago = fs::last_write_time(first) - std::chrono::hours(1);
    fs::last_write_time(first, long_ago);
    for (int k = 2; k < 6; ++k)
      add(file, k);
    EXPECT_EQ(fs::last_write_time(first), long_ago);
  }

  // Closed, or killed in the midst of a stage: what was complete stands, what was not is not looked at.
  TEST_F(Stages, AreTakenUpWhereTheCheckpointSays)
  {
    for (const bool closed : {false, true})
      {
        {
          StagedFile first(path);
          for (const int k : {1, 2, 3})
            add(first, k);
          if (closed)
            first.close();
        }
        if (!closed)
          std::ofstream(path + "/stage_0003.h5.part") << "half";
        StagedFile file(path, 2);
        EXPECT_EQ(file.size(), 2u);
        EXPECT_EQ(times(), (std::vector<double>{1, 2}));
        add(file, 5);
        EXPECT_EQ(times(), (std::vector<double>{1, 2, 5}));
        file.close();
        EXPECT_EQ(times(), (std::vector<double>{1, 2, 5}));
      }
  }

  TEST_F(Stages, FewerThanTheCheckpointGoesOnFromAreRefused)
  {
    {
      StagedFile file(path);
      add(file, 1);
    }
    EXPECT_THROW(StagedFile(path, 2), std::invalid_argument);
    EXPECT_THROW(StagedFile(folder / "other", 1), std::invalid_argument);
  }

  // The folder may be moved before the file is closed: links are relative.
  TEST_F(Stages, MoveWithTheirFolder)
  {
    {
      StagedFile file(path);
      add(file, 1), add(file, 2);
    }
    const std::string other = folder.path + "_moved";
    fs::rename(folder.path, other);
    const Hdf5Reader file(other + "/panel.h5");
    EXPECT_EQ(file.attribute(stage_name(1), "time"), 2);
    fs::rename(other, folder.path);
  }
} // namespace
