// diptych: what the continuum panel's files hold is what was given to them
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <regex>
#include <set>

#include <hdf5.h>

#include <gtest/gtest.h>

#include "tests/continuum/output_examples.h"

namespace
{
  using namespace diptych::continuum;
  using namespace diptych::continuum::tests::output;

  TEST(Output, EveryFieldOfEveryStageComesBackBitByBit)
  {
    const Folder folder;
    Snapshot     odd                  = example(1, 0.1, true);
    odd.cell_state[0].stress(1, 0)    = std::nan("");
    odd.cell_state[0].overstress      = -0.;
    odd.rotation[3]                   = 5e-324;
    odd.displacement[2].y()           = -std::numeric_limits<double>::infinity();
    const std::vector<Snapshot> given = {example(2, 0, true), odd, example(3, 0.2, false)}; // another mesh at every stage
    ResultFiles                 files(folder.path);
    for (const Snapshot &s : given)
      files.add(s);
    const std::vector<Snapshot> read = read_snapshots(folder / "continuum.h5");
    ASSERT_EQ(read.size(), given.size());
    for (std::size_t k = 0; k < given.size(); ++k)
      {
        SCOPED_TRACE("stage " + std::to_string(k));
        expect_same(given[k], read[k]);
        expect_same(given[k], read_snapshot(folder / "continuum.h5", k));
      }
    EXPECT_TRUE(read[2].rotation.empty());
    for (const auto &entry : fs::recursive_directory_iterator(folder.path))
      EXPECT_NE(entry.path().extension(), ".part") << entry.path();
  }

  // A file of an older version is one without some of the datasets.
  TEST(Output, AMissingDatasetIsNamedWithFileAndStage)
  {
    const Folder      folder;
    const std::string h5 = folder / "continuum.h5";
    for (const std::string name : {"cells/plastic_strain", "cells/nodes", "nodes/weight", "cells/acoustic_determinant"})
      {
        append_to_hdf5(h5, example(1, 0, true), 0);
        append_to_hdf5(h5, example(2, 0.1, true), 1);
        const hid_t file = H5Fopen(h5.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
        ASSERT_GE(H5Ldelete(file, ("stage_0001/" + name).c_str(), H5P_DEFAULT), 0);
        H5Fclose(file);
        expect_error_naming({h5, "stage_0001", name, "missing"}, [&] { (void)read_snapshots(h5); });
      }
  }

  TEST(Output, CutShortDamagedForeignAndMissingFilesAreNamed)
  {
    const Folder      folder;
    const std::string h5   = folder / "continuum.h5";
    const auto        read = [&] { (void)read_snapshots(h5); };
    expect_error_naming({h5, "does not exist"}, read);
    put(h5, "no HDF5");
    expect_error_naming({h5}, read);

    const Snapshot s = example(2, 0, true);
    append_to_hdf5(h5, s, 0);
    const std::string whole = contents_of(h5);
    for (const double share : {0., 0.2, 0.99})
      {
        put(h5, whole.substr(0, std::size_t(share * whole.size())));
        expect_error_naming({h5}, read);
      }

    std::string       damaged = whole;
    const std::size_t place   = damaged.find(
        std::string(reinterpret_cast<const char *>(&s.cell_state[1].dissipation), sizeof(double)));
    ASSERT_NE(place, std::string::npos);
    damaged[place] ^= 1;
    put(h5, damaged);
    expect_error_naming({h5, "stage_0000", "cells/dissipation"}, read);

    H5Fclose(H5Fcreate(h5.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
    expect_error_naming({h5, "stage_0000"}, read);
  }

  TEST(Output, ListsOfDifferentLengthAreRefusedAndTheFileStays)
  {
    const Folder      folder;
    const std::string h5 = folder / "continuum.h5";
    append_to_hdf5(h5, example(1, 0, true), 0);
    const std::string before = contents_of(h5);
    for (const int which : {0, 1, 2})
      {
        Snapshot s = example(1, 0.1, true);
        which == 0 ? s.rotation.pop_back() : which == 1 ? s.displacement.pop_back() : s.cell_state.pop_back();
        EXPECT_THROW(append_to_hdf5(h5, s, 1), std::invalid_argument) << which;
        EXPECT_THROW(write_vtu(folder / "wrong.vtu", s), std::invalid_argument) << which;
      }
    EXPECT_EQ(contents_of(h5), before);
    EXPECT_FALSE(fs::exists(folder / "wrong.vtu"));
  }

  const std::map<std::string, std::string> node_fields = {{"displacement", "Vector"},
                                                          {"rotation", "Scalar"},
                                                          {"weight", "Scalar"}};
  const std::map<std::string, std::string> cell_fields = {{"stress", "Tensor"},
                                                          {"strain", "Tensor"},
                                                          {"plastic_strain", "Tensor"},
                                                          {"couple_stress", "Vector"},
                                                          {"area", "Scalar"},
                                                          {"equivalent_plastic_strain", "Scalar"},
                                                          {"dissipation", "Scalar"},
                                                          {"overstress", "Scalar"},
                                                          {"share_zz_not_intermediate", "Scalar"},
                                                          {"acoustic_determinant", "Scalar"},
                                                          {"localisation_angle", "Scalar"}};

  std::string extents_in(const hid_t file, const std::string &path)
  {
    const hid_t set = H5Dopen2(file, path.c_str(), H5P_DEFAULT);
    if (set < 0)
      return "no such dataset";
    const hid_t space    = H5Dget_space(set);
    hsize_t     sizes[3] = {0, 0, 0};
    const int   rank     = H5Sget_simple_extent_dims(space, sizes, nullptr);
    std::string text     = std::to_string(sizes[0]);
    for (int k = 1; k < rank; ++k)
      text += " " + std::to_string(sizes[k]);
    H5Sclose(space), H5Dclose(set);
    return text;
  }

  // ParaView takes names, kinds and extents from the .xdmf and the numbers from the .h5.
  TEST(Output, XdmfListsEveryFieldWithTheExtentsOfItsDataset)
  {
    const Folder folder;
    ResultFiles  files(folder.path);
    files.add(example(2, 0.1, true));
    files.add(example(3, 0.3, false));
    const std::string xdmf = contents_of(folder / "continuum.xdmf");

    std::set<std::string> listed, expected;
    const std::regex      attribute("<Attribute Name=\"(\\w+)\" AttributeType=\"(\\w+)\" Center=\"(\\w+)\"><DataItem[^>]*>"
                                         "continuum.h5:/(\\w+)/(\\w+)/(\\w+)<");
    for (std::sregex_iterator m(xdmf.begin(), xdmf.end(), attribute), end; m != end; ++m)
      {
        EXPECT_EQ((*m)[1], (*m)[6]);
        EXPECT_EQ((*m)[5], (*m)[3] == "Node" ? "nodes" : "cells");
        listed.insert((*m)[4].str() + ' ' + (*m)[1].str() + ' ' + (*m)[2].str() + ' ' + (*m)[3].str());
      }
    for (const std::string stage : {"stage_0000", "stage_0001"})
      {
        for (const auto &[name, type] : node_fields)
          if (stage == "stage_0000" || name != "rotation")
            expected.insert(stage + ' ' + name + ' ' + type + " Node");
        for (const auto &[name, type] : cell_fields)
          expected.insert(stage + ' ' + name + ' ' + type + " Cell");
      }
    EXPECT_EQ(listed, expected);

    const hid_t      file = H5Fopen((folder / "continuum.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    const std::regex item("<DataItem Dimensions=\"([0-9 ]+)\"[^>]*>continuum.h5:/([^<]+)<");
    std::size_t      n_items = 0;
    for (std::sregex_iterator m(xdmf.begin(), xdmf.end(), item), end; m != end; ++m, ++n_items)
      EXPECT_EQ((*m)[1], extents_in(file, (*m)[2])) << (*m)[2];
    H5Fclose(file);
    EXPECT_EQ(n_items, expected.size() + 2 * 2); // and topology and geometry of both stages
    EXPECT_NE(xdmf.find("<Time Value=\"0.1\"/>"), std::string::npos);
    EXPECT_NE(xdmf.find("/cells/stress<"), std::string::npos);
    EXPECT_NE(xdmf.find("Dimensions=\"4 3 3\""), std::string::npos);
    EXPECT_NE(xdmf.find("Dimensions=\"9 3 3\""), std::string::npos);
  }

  std::string from_base64(const std::string &text)
  {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string       bytes;
    unsigned int      bits = 0, n_bits = 0;
    for (const char c : text)
      if (const std::size_t digit = digits.find(c); digit != std::string::npos)
        {
          bits = bits << 6 | digit;
          n_bits += 6;
          if (n_bits >= 8)
            bytes.push_back(char(bits >> (n_bits -= 8) & 255));
        }
    return bytes;
  }

  // What a reader of the .vtu sees of one array.
  struct Array
  {
    std::string type, n_components, bytes;

    template <class T> std::vector<T> as() const
    {
      std::vector<T> values(bytes.size() / sizeof(T));
      std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
      return values;
    }
  };

  std::map<std::string, Array> arrays_of(const std::string &vtu)
  {
    std::map<std::string, Array> arrays;
    const std::regex head("<DataArray type=\"(\\w+)\" Name=\"(\\w+)\" NumberOfComponents=\"(\\d+)\" format=\"binary\">\n");
    for (std::sregex_iterator m(vtu.begin(), vtu.end(), head), end; m != end; ++m)
      {
        const std::size_t begin = m->position() + m->length();
        const std::string raw   = from_base64(vtu.substr(begin, vtu.find('<', begin) - begin));
        std::uint64_t     n_bytes;
        std::memcpy(&n_bytes, raw.data(), sizeof n_bytes);
        EXPECT_EQ(n_bytes, raw.size() - sizeof n_bytes) << (*m)[2];
        arrays[(*m)[2]] = {(*m)[1], (*m)[3], raw.substr(sizeof n_bytes)};
      }
    return arrays;
  }

  TEST(Output, VtuHoldsEveryFieldWithAllBits)
  {
    const Folder folder;
    for (const bool cosserat : {true, false})
      for (const unsigned int n : {1u, 2u, 3u}) // 9, 25, 49 nodes: base64 with and without padding
        {
          SCOPED_TRACE("rotation " + std::to_string(cosserat) + ", n " + std::to_string(n));
          const Snapshot s = example(n, 0.1, cosserat);
          write_vtu(folder / "a.vtu", s);
          const std::string vtu    = contents_of(folder / "a.vtu");
          const auto        arrays = arrays_of(vtu);
          EXPECT_NE(vtu.find("byte_order=\"LittleEndian\" header_type=\"UInt64\""), std::string::npos);
          EXPECT_NE(vtu.find("NumberOfPoints=\"" + std::to_string(s.position.size()) + "\" NumberOfCells=\"" +
                             std::to_string(n * n) + "\""),
                    std::string::npos);
          EXPECT_EQ(arrays.count("rotation"), cosserat);
          const std::map<std::string, std::string> components{{"Scalar", "1"}, {"Vector", "3"}, {"Tensor", "9"}};
          const auto expect_field = [&](const std::string &name, const std::string &type, const std::size_t n_items) {
            ASSERT_EQ(arrays.count(name), 1u) << name;
            const Array &array = arrays.at(name);
            EXPECT_EQ(array.type, "Float64") << name;
            EXPECT_EQ(array.n_components, components.at(type)) << name;
            EXPECT_EQ(array.bytes.size(), n_items * std::stoul(array.n_components) * sizeof(double)) << name;
          };
          expect_field("position", "Vector", s.position.size());
          for (const auto &[name, type] : node_fields)
            if (cosserat || name != "rotation")
              expect_field(name, type, s.position.size());
          for (const auto &[name, type] : cell_fields)
            expect_field(name, type, s.cells.size());

          const auto stress = arrays.at("stress").as<double>(), couple = arrays.at("couple_stress").as<double>(),
                     position = arrays.at("position").as<double>();
          for (std::size_t c = 0; c < s.cells.size(); ++c)
            {
              for (int i = 0; i < 3; ++i)
                for (int j = 0; j < 3; ++j)
                  EXPECT_EQ(stress[9 * c + 3 * i + j], s.cell_state[c].stress(i, j));
              EXPECT_EQ(couple[3 * c], s.cell_state[c].couple_stress.x());
              EXPECT_EQ(couple[3 * c + 1], s.cell_state[c].couple_stress.y());
              EXPECT_EQ(couple[3 * c + 2], 0);
            }
          EXPECT_EQ(position[3 * 4 + 1], s.position[4].y());
          if (cosserat)
            {
              EXPECT_EQ(arrays.at("rotation").as<double>(), s.rotation);
            }
          EXPECT_EQ(arrays.at("weight").as<double>(), s.weight);
        }
  }

  // VTK's cell 28 has nine nodes: offsets point behind each cell's last one.
  TEST(Output, VtuCellsAreBiquadraticQuadrilaterals)
  {
    const Folder   folder;
    const Snapshot s = example(2, 0.1, true);
    write_vtu(folder / "a.vtu", s);
    const auto arrays = arrays_of(contents_of(folder / "a.vtu"));
    EXPECT_EQ(arrays.at("offsets").type, "Int32");
    EXPECT_EQ(arrays.at("offsets").as<std::int32_t>(), (std::vector<std::int32_t>{9, 18, 27, 36}));
    EXPECT_EQ(arrays.at("types").type, "UInt8");
    EXPECT_EQ(arrays.at("types").as<std::uint8_t>(), std::vector<std::uint8_t>(4, 28));
    const auto connectivity = arrays.at("connectivity").as<std::int32_t>();
    ASSERT_EQ(connectivity.size(), 36u);
    for (std::size_t k = 0; k < 36; ++k)
      EXPECT_EQ(connectivity[k], std::int32_t(s.cells[k / 9][k % 9]));
  }
} // namespace
