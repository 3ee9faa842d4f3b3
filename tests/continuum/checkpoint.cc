// diptych: a continuum run put down in a file comes back bit by bit, or is refused by name
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

#include <sys/resource.h>
#include <unistd.h>

#include <hdf5.h>

#include <gtest/gtest.h>

#include "continuum/checkpoint.h"

namespace
{
  using namespace diptych::continuum;
  namespace fs = std::filesystem;

  struct TemporaryFile
  {
    std::string path = (fs::path(testing::TempDir()) / ("diptych_checkpoint" + std::to_string(::getpid()) + ".h5")).string();
    ~TemporaryFile() { fs::remove(path); }
  };

  Checkpoint example()
  {
    Checkpoint c;
    c.fingerprint     = "mesh 17, law cosserat_mohr_coulomb\nfriction 45";
    c.cells           = {"0_0:", "0_1:3", "12_2:01"};
    c.values_per_cell = 4;
    c.values          = {1. / 3, -0., std::nan("7"), 5e-324, 1e308, -std::numeric_limits<double>::infinity(),
                         0.1,    0.,  -1e-300,       2,      -3,    std::nextafter(1., 2.)};
    c.scalars         = {{"axial_strain", 0.1 + 0.2}, {"worst", -std::nan("")}, {"step", 1e-5}};
    c.counts          = {{"steps", 9007199254740993}, {"cut_backs", -1}};
    return c;
  }

  bool same_bits(const double a, const double b)
  {
    return std::memcmp(&a, &b, sizeof a) == 0;
  }

  void expect_same(const Checkpoint &a, const Checkpoint &b)
  {
    EXPECT_EQ(a.fingerprint, b.fingerprint);
    EXPECT_EQ(a.cells, b.cells);
    EXPECT_EQ(a.values_per_cell, b.values_per_cell);
    ASSERT_EQ(a.values.size(), b.values.size());
    for (std::size_t k = 0; k < a.values.size(); ++k)
      EXPECT_TRUE(same_bits(a.values[k], b.values[k])) << "value " << k << ": " << a.values[k] << ", " << b.values[k];
    EXPECT_EQ(a.counts, b.counts);
    ASSERT_EQ(a.scalars.size(), b.scalars.size());
    for (const auto &[name, value] : a.scalars)
      EXPECT_TRUE(same_bits(value, b.scalars.at(name))) << name;
  }

  std::string contents_of(const std::string &path)
  {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  void put(const std::string &path, const std::string &contents)
  {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << contents;
  }

  void expect_refusal_naming(const std::string &path, const std::string &reason)
  {
    try
      {
        (void)read_checkpoint(path);
        FAIL() << "no error";
      }
    catch (const std::runtime_error &error)
      {
        EXPECT_NE(std::string(error.what()).find(path), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
      }
  }

  void relink(const std::string &path, const std::string &from, const std::string &to)
  {
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    ASSERT_GE(H5Lmove(file, from.c_str(), file, to.c_str(), H5P_DEFAULT, H5P_DEFAULT), 0);
    H5Fclose(file);
  }

  TEST(Checkpoint, ComesBackBitByBit)
  {
    const TemporaryFile file;
    const Checkpoint    c = example();
    write_checkpoint(file.path, c);
    expect_same(read_checkpoint(file.path), c);
    EXPECT_FALSE(fs::exists(file.path + ".part"));
  }

  TEST(Checkpoint, AnEmptyOneAndManyCellsComeBack)
  {
    const TemporaryFile file;
    write_checkpoint(file.path, {});
    expect_same(read_checkpoint(file.path), {});

    Checkpoint many = example(); // more rows than one checksummed piece of 4096
    many.cells.clear();
    many.values.clear();
    for (int k = 0; k < 10000; ++k)
      {
        many.cells.push_back(std::to_string(100000 + k) + "_0:");
        for (unsigned int i = 0; i < many.values_per_cell; ++i)
          many.values.push_back(std::sin(k + 0.1 * i));
      }
    write_checkpoint(file.path, many);
    expect_same(read_checkpoint(file.path), many);
  }

  TEST(Checkpoint, TheSecondReplacesTheFirst)
  {
    const TemporaryFile file;
    write_checkpoint(file.path, example());
    Checkpoint later = example();
    later.cells.pop_back();
    later.values.resize(8);
    later.counts = {{"steps", 5}};
    write_checkpoint(file.path, later);
    expect_same(read_checkpoint(file.path), later);
  }

  TEST(Checkpoint, AFileCutShortAnywhereIsRefusedByName)
  {
    const TemporaryFile file;
    write_checkpoint(file.path, example());
    const std::string whole = contents_of(file.path);
    for (const double share : {0., 0.01, 0.3, 0.9, 0.999})
      {
        put(file.path, whole.substr(0, std::size_t(share * whole.size())));
        expect_refusal_naming(file.path, "");
      }
  }

  // One bit of one value: only the checksum can tell.
  TEST(Checkpoint, AFlippedBitIsRefusedByName)
  {
    const TemporaryFile file;
    const Checkpoint    c = example();
    write_checkpoint(file.path, c);
    std::string       contents = contents_of(file.path);
    const std::string number(reinterpret_cast<const char *>(&c.values[0]), sizeof(double));
    const std::size_t place = contents.find(number);
    ASSERT_NE(place, std::string::npos);
    contents[place] ^= 1;
    put(file.path, contents);
    expect_refusal_naming(file.path, "cells/values");
  }

  TEST(Checkpoint, MissingAndForeignFilesAreRefusedByName)
  {
    const TemporaryFile file;
    expect_refusal_naming(file.path, "does not exist");
    put(file.path, "step,axial_strain\n");
    expect_refusal_naming(file.path, "no HDF5 file");
    write_checkpoint(file.path, example());
    relink(file.path, "format", "other");
    expect_refusal_naming(file.path, "diptych continuum checkpoint");
    relink(file.path, "fingerprint", "format"); // another text there
    expect_refusal_naming(file.path, "diptych continuum checkpoint");
  }

  TEST(Checkpoint, AMissingPartIsNamed)
  {
    const TemporaryFile file;
    for (const std::string name : {"fingerprint", "cells/values", "cells/ids", "scalars/names", "counts/values"})
      {
        write_checkpoint(file.path, example());
        relink(file.path, name, "elsewhere");
        expect_refusal_naming(file.path, name);
      }
  }

  TEST(Checkpoint, ContentsThatContradictEachOtherAreNotWritten)
  {
    const TemporaryFile file;
    Checkpoint          short_of_a_value = example();
    short_of_a_value.values.pop_back();
    EXPECT_THROW(write_checkpoint(file.path, short_of_a_value), std::invalid_argument);
    Checkpoint two_lines = example();
    two_lines.cells[1]   = "0_1:\n3";
    EXPECT_THROW(write_checkpoint(file.path, two_lines), std::invalid_argument);
    EXPECT_FALSE(fs::exists(file.path));
  }

  // A limit on the size of files stands in for a full disk.
  TEST(Checkpoint, AFullDiskLeavesTheLastOne)
  {
    const TemporaryFile file;
    write_checkpoint(file.path, example());
    Checkpoint large      = example();
    large.values_per_cell = 100000;
    large.values.assign(300000, 1.5);

    rlimit before;
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto   handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{100000, before.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    EXPECT_THROW(write_checkpoint(file.path, large), std::runtime_error);
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
    std::signal(SIGXFSZ, handler);

    expect_same(read_checkpoint(file.path), example());
    EXPECT_FALSE(fs::exists(file.path + ".part"));
    write_checkpoint(file.path, large);
    expect_same(read_checkpoint(file.path), large);
  }
} // namespace
