// diptych: an HDF5 file is whole or absent, and what it holds is not believed before it is checked
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <csignal>
#include <memory>

#include <sys/resource.h>
#include <sys/stat.h>

#include <hdf5.h>

#include "discrete/files/hdf5_file.h"
#include "discrete/files/text_file.h"
#include "tests/common.h"

// The library keeps open objects of a file with a turned bit that it has already read (HDF5 1.10); it closes
// itself the objects that we leave open.
extern "C" const char *__lsan_default_suppressions()
{
  return "leak:libhdf5";
}

namespace
{
  using namespace diptych::discrete;
  using namespace diptych::tests;
  namespace fs = std::filesystem;

  struct Hdf5 : testing::Test
  {
    const Folder              folder;
    const std::string         path   = folder / "a.h5";
    const std::vector<double> values = std::vector<double>(20000, 0.7251);

    void write() const
    {
      Hdf5Writer file(path);
      file.write("group/values", values);
      file.write("group/counts", std::vector<int>{1, 2, 3});
      file.finish();
    }
  };

  TEST_F(Hdf5, WithoutFinishNothingIsWritten)
  {
    write();
    const auto size = fs::file_size(path);
    {
      Hdf5Writer file(path);
      file.write("other", std::vector<double>{1.});
    }
    EXPECT_EQ(fs::file_size(path), size);
    EXPECT_TRUE(Hdf5Reader(path).has("group/values"));
  }

  // One bit of one number turned over on the disk: the checksum tells, and the message names file and array.
  TEST_F(Hdf5, ATurnedBitIsRefused)
  {
    write();
    std::string       bytes = read_text(path);
    const std::size_t at    = bytes.find(
         std::string(reinterpret_cast<const char *>(values.data()), sizeof(double))); // not compressed
    ASSERT_NE(at, std::string::npos);
    bytes[at] ^= 1;
    write_text(path, bytes);
    const Hdf5Reader reader(path);
    EXPECT_EQ(reader.read_int("group/counts"), (std::vector<int>{1, 2, 3}));
    expect_refused({path, "group/values"}, [&] { reader.read("group/values"); });
  }

  // Arrays, scalars, attributes, names and indices: one bit of every byte turned over gives an error or the same content.
  TEST_F(Hdf5, NoTurnedBitAnywhereChangesWhatIsRead)
  {
    const auto content = [&] {
      const Hdf5Reader          file(path);
      std::vector<double>       all = file.read("stage/values");
      const std::vector<double> one = file.attributes("stage", "progress"), several = file.attributes("stage", "several");
      const std::vector<int>    body = file.read_int("stage/body");
      all.insert(all.end(), one.begin(), one.end()), all.insert(all.end(), several.begin(), several.end());
      all.insert(all.end(), body.begin(), body.end());
      for (const std::string &text : {file.read_string("scene"), file.text_attribute("stage", "unit")})
        all.insert(all.end(), text.begin(), text.end());
      const std::vector<std::string> names = file.members("stage");
      all.push_back(double(names.size()));
      return all;
    };
    {
      Hdf5Writer file(path);
      file.write("stage/values", std::vector<double>{0.1, 0.2, 0.3});
      file.write("stage/body", std::vector<int>{1, 2, 3, 4}, {2, 2});
      file.write_string("scene", "sample/grains = 300");
      for (int k = 0; k < 12; ++k) // more than an object's header holds
        file.attribute("stage", "number_" + std::to_string(k), double(k));
      file.attribute("stage", "progress", 0.25);
      file.attribute("stage", "several", std::vector<double>{1, 2});
      file.attribute("stage", "unit", "length");
      file.finish();
    }
    const std::vector<double> whole   = content();
    const std::string         bytes   = read_text(path);
    int                       refused = 0;
    for (std::size_t k = 0; k < bytes.size(); ++k)
      {
        std::string damaged = bytes;
        damaged[k]          = char(damaged[k] ^ (1 << (k * 5 % 8)));
        write_text(path, damaged);
        refused += refusal([&] { EXPECT_EQ(content(), whole) << "byte " << k; }) != "";
      }
    EXPECT_GT(refused, 1000);
  }

  // Many links are kept in a heap; a table of them, half made, once took the program with it.
  TEST_F(Hdf5, ADamagedListOfManyArraysIsRefused)
  {
    std::vector<std::string> names;
    {
      Hdf5Writer file(path);
      for (int k = 10; k < 30; ++k)
        file.write("group/" + names.emplace_back("array_" + std::to_string(k)), std::vector<double>{1. * k});
      file.finish();
    }
    EXPECT_EQ(Hdf5Reader(path).members("group"), names);
    const std::string bytes = read_text(path);
    const std::size_t heap = bytes.find("FHDB"), length = 400;
    ASSERT_NE(heap, std::string::npos);
    for (std::size_t at = heap; at < heap + length; at += 3)
      {
        std::string changed = bytes;
        changed[at] ^= 1;
        write_text(path, changed);
        (void)refusal([&] { EXPECT_EQ(Hdf5Reader(path).members("group"), names); });
        (void)refusal<std::exception>([&] { Hdf5Writer(path + ".copy").copy(Hdf5Reader(path), "group"); });
        (void)refusal<std::exception>([&] { Hdf5Writer(path + ".copy").copy_values(Hdf5Reader(path), "group"); });
      }
  }

  // A limit on the size of files acts as a full disk does: the write fails half way. The file of that name stays as it was, the
  // program goes on, and the next file can be written.
  TEST_F(Hdf5, AFullDiskLeavesTheOldFileAndTheProgram)
  {
    write();
    const auto size = fs::file_size(path);
    rlimit     before{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    std::signal(SIGXFSZ, SIG_IGN);
    for (const bool on_disk : {false, true})
      {
        rlimit small   = before;
        small.rlim_cur = 50000;
        ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
        EXPECT_THROW(
          {
            std::unique_ptr<Hdf5Writer> file(on_disk ? new Hdf5Writer(path, 8 * values.size()) : new Hdf5Writer(path));
            file->write("group/values", values);
            file->finish();
          },
          std::runtime_error);
        ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
        EXPECT_EQ(fs::file_size(path), size);
        EXPECT_FALSE(fs::exists(path + ".part"));
      }
    std::signal(SIGXFSZ, SIG_DFL);
    write();
    EXPECT_EQ(Hdf5Reader(path).read("group/values"), values);
  }

  TEST_F(Hdf5, AFolderThatIsNotThereIsNamed)
  {
    const std::string lost = folder / "no/such/folder/file.h5";
    expect_refused<std::runtime_error>({lost}, [&] {
      Hdf5Writer file(lost);
      file.write("x", values);
      file.finish();
    });
  }

  TEST_F(Hdf5, ArraysOfAnotherTypeOrShapeAreRefused)
  {
    write();
    const Hdf5Reader file(path);
    EXPECT_THROW(file.read_int("group/values"), std::invalid_argument);
    EXPECT_THROW(file.read_vectors("group/values"), std::invalid_argument);
    EXPECT_THROW(file.read("group/nothing"), std::invalid_argument);
    EXPECT_THROW(file.attribute("group", "nothing"), std::invalid_argument);
  }

  TEST_F(Hdf5, APipeIsRefusedBeforeItIsOpened)
  {
    ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
    EXPECT_THROW(Hdf5Reader{path}, std::invalid_argument);
  }

  struct Hdf5Types : testing::Test
  {
    const Folder      folder;
    const std::string path = folder / "a.h5";

    // 1, 2, 3 as another program stores them (version 1.8 of the format, without checksums), in an array and an attribute.
    void write(const hid_t type) const
    {
      const double  values[] = {1, 2, 3};
      const hsize_t n        = 3;
      const hid_t   file     = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
      const hid_t   space = H5Screate_simple(1, &n, nullptr), one = H5Screate(H5S_SCALAR);
      const hid_t   array     = H5Dcreate2(file, "values", type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
      const hid_t   attribute = H5Acreate2(array, "first", type, one, H5P_DEFAULT, H5P_DEFAULT);
      H5Dwrite(array, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
      H5Awrite(attribute, H5T_NATIVE_DOUBLE, values);
      H5Aclose(attribute), H5Dclose(array), H5Sclose(one), H5Sclose(space);
      ASSERT_GE(H5Fclose(file), 0);
    }

    void expect_refused() const
    {
      const Hdf5Reader reader(path, Hdf5Reader::From::anybody);
      EXPECT_THROW((void)reader.read("values"), std::invalid_argument);
      EXPECT_THROW((void)reader.attribute("values", "first"), std::invalid_argument);
    }
  };

  TEST_F(Hdf5Types, UsualTypesOfOtherProgramsAreRead)
  {
    for (const hid_t type : {H5T_IEEE_F32BE, H5T_IEEE_F64LE, H5T_STD_I8LE, H5T_STD_U16BE, H5T_STD_I32BE, H5T_STD_U64LE})
      {
        write(type);
        const Hdf5Reader reader(path, Hdf5Reader::From::anybody);
        EXPECT_EQ(reader.read("values"), (std::vector<double>{1, 2, 3}));
        EXPECT_EQ(reader.attribute("values", "first"), 1);
      }
  }

  TEST_F(Hdf5Types, IntegersOfSomeBitsAreRefused)
  {
    const hid_t type = H5Tcopy(H5T_STD_I32LE);
    H5Tset_precision(type, 13);
    H5Tset_offset(type, 7);
    write(type);
    H5Tclose(type);
    expect_refused();
  }

  // The library turns them by the offset that stands in the file, which nothing bounds: HDF5 1.10 writes beyond its own memory.
  TEST_F(Hdf5Types, BitsBeyondTheNumberAreRefused)
  {
    write(H5T_STD_I32LE);
    std::string bytes = read_text(path);
    // Class and version, three bytes of flags (signed), size; then the offset and the number of bits, as the file format says
    // them.
    const std::string whole("\x10\x08\0\0\x04\0\0\0\0\0\x20\0", 12);
    int               found = 0;
    for (std::size_t at = bytes.find(whole); at != std::string::npos; at = bytes.find(whole, at + 1), ++found)
      bytes[at + 9] = 0x3e;
    ASSERT_EQ(found, 2);
    write_text(path, bytes);
    expect_refused();
  }
} // namespace
