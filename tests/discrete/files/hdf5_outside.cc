// diptych: no HDF5 file leads its reader into another one
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <sys/stat.h>

#include <hdf5.h>

#include "discrete/files/hdf5_file.h"
#include "tests/common.h"

namespace
{
  using namespace diptych::discrete;
  using namespace diptych::tests;

  // A file of ours with an array and a text, which a test opens with the library, as anybody may, to put something else there.
  struct Hdf5Outside : testing::Test
  {
    const Folder      folder;
    const std::string path = folder / "own.h5", pipe = folder / "pipe.h5";

    void SetUp() override
    {
      ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
      Hdf5Writer file(path);
      file.write("group/values", std::vector<double>{1, 2, 3});
      file.attribute("group", "name", "axial_strain");
      file.finish();
    }

    template <class Change> void change(const Change &change) const
    {
      const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
      change(file);
      ASSERT_GE(H5Fclose(file), 0);
    }

    // The array again, stored as `set` makes the properties say.
    template <class Set> void change_storage(const Set &set) const
    {
      change([&](const hid_t file) {
        H5Ldelete(file, "group/values", H5P_DEFAULT);
        const hsize_t n     = 3;
        const hid_t   space = H5Screate_simple(1, &n, nullptr), properties = H5Pcreate(H5P_DATASET_CREATE);
        ASSERT_GE(set(properties, space), 0);
        const hid_t array = H5Dcreate2(file, "group/values", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, properties, H5P_DEFAULT);
        ASSERT_GE(array, 0);
        H5Dclose(array), H5Pclose(properties), H5Sclose(space);
      });
    }

    // Every way to it throws, naming file and object, and none waits for the pipe: the test would never end.
    void expect_array_refused() const
    {
      const Hdf5Reader reader(path);
      const auto       refused = [&](const auto &ask) { expect_refused({path, "group"}, ask); };
      refused([&] { (void)reader.read("group/values"); });
      refused([&] { (void)reader.extents("group/values"); });
      refused([&] { Hdf5Writer(folder / "copy.h5").copy(reader, "group"); });
      refused([&] { Hdf5Writer(folder / "copy.h5").copy_values(reader, "group"); });
    }
  };

  TEST_F(Hdf5Outside, LinksAreNotFollowed)
  {
    change([&](const hid_t file) {
      H5Ldelete(file, "group/values", H5P_DEFAULT);
      ASSERT_GE(H5Lcreate_external(pipe.c_str(), "/x", file, "group/values", H5P_DEFAULT, H5P_DEFAULT), 0);
    });
    const Hdf5Reader reader(path);
    EXPECT_THROW((void)reader.read("group/values"), std::invalid_argument);
    EXPECT_THROW((void)reader.has("group/values/below"), std::invalid_argument);
    EXPECT_THROW((void)reader.members("group/values"), std::invalid_argument);
    EXPECT_THROW((void)reader.has_attribute("group/values", "unit"), std::invalid_argument);
    EXPECT_THROW((void)reader.text_attribute("group/values", "unit"), std::invalid_argument);
    EXPECT_THROW(Hdf5Writer(folder / "copy.h5").copy_values(reader, "group"), std::invalid_argument);
  }

  // A link within the file that leads to one out of it.
  TEST_F(Hdf5Outside, LinksBehindLinksAreNotFollowed)
  {
    change([&](const hid_t file) {
      H5Ldelete(file, "group/values", H5P_DEFAULT);
      H5Lcreate_external(pipe.c_str(), "/", file, "away", H5P_DEFAULT, H5P_DEFAULT);
      ASSERT_GE(H5Lcreate_soft("/away/x", file, "group/values", H5P_DEFAULT, H5P_DEFAULT), 0);
    });
    EXPECT_THROW((void)Hdf5Reader(path).read("group/values"), std::invalid_argument);
  }

  TEST_F(Hdf5Outside, NumbersInOtherFilesAreNotRead)
  {
    change_storage([&](const hid_t properties, hid_t) { return H5Pset_external(properties, pipe.c_str(), 0, H5F_UNLIMITED); });
    expect_array_refused();
  }

  TEST_F(Hdf5Outside, VirtualArraysAreNotRead)
  {
    change_storage(
      [&](const hid_t properties, const hid_t space) { return H5Pset_virtual(properties, space, pipe.c_str(), "/x", space); });
    expect_array_refused();
  }

  // More texts than one would be written beyond the memory of one.
  TEST_F(Hdf5Outside, AnAttributeOfManyTextsIsNone)
  {
    change([&](const hid_t file) {
      const hsize_t n    = 4000;
      const hid_t   type = H5Tcopy(H5T_C_S1), space = H5Screate_simple(1, &n, nullptr);
      H5Tset_size(type, 13);
      H5Adelete_by_name(file, "group", "name", H5P_DEFAULT);
      const hid_t attribute = H5Acreate_by_name(file, "group", "name", type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
      ASSERT_GE(H5Awrite(attribute, type, std::string(13 * n, 'a').data()), 0);
      H5Aclose(attribute), H5Sclose(space), H5Tclose(type);
    });
    EXPECT_THROW((void)Hdf5Reader(path).text_attribute("group", "name"), std::invalid_argument);
  }
} // namespace
