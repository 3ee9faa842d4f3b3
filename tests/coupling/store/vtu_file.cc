// diptych: what a reader of VTK files finds in ours
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/files/vtu_file.h"

#include <regex>

#include "coupling/store/continuum_snapshot_file.h"
#include "tests/coupling/store/examples.h"

namespace
{
  using namespace diptych::coupling::files;
  using discrete::VtkCell;
  using discrete::VtuField;
  using discrete::VtuGrid;
  using discrete::write_vtu;

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

  // One array as a reader of the .vtu sees it.
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

  // 1 to 9 points and values of one, three and nine components: base64 with and without padding.
  TEST(VtuFile, HoldsEveryFieldInSinglePrecision)
  {
    const Folder folder;
    for (std::size_t n = 1; n < 10; ++n)
      for (const unsigned int components : {1u, 3u, 9u})
        {
          SCOPED_TRACE(std::to_string(n) + " points, " + std::to_string(components) + " components");
          Numbers next{int(n)};
          VtuGrid grid;
          for (std::size_t k = 0; k < n; ++k)
            grid.points.emplace_back(next(), next());
          grid.cells = {0, 0, 0, 0, 0, 0, 0, 0};
          VtuField of_nodes{"velocity", components, {}, true}, of_cells{"stress", components, {}, false};
          for (std::size_t k = 0; k < n * components; ++k)
            of_nodes.values.push_back(next());
          for (std::size_t k = 0; k < 2 * components; ++k)
            of_cells.values.push_back(next());
          of_cells.values[0] = std::nan("");
          grid.fields        = {of_nodes, of_cells};
          write_vtu(folder / "a.vtu", grid);
          const std::string vtu    = read_text(folder / "a.vtu");
          const auto        arrays = arrays_of(vtu);
          EXPECT_NE(vtu.find("byte_order=\"LittleEndian\" header_type=\"UInt64\""), std::string::npos);
          EXPECT_NE(vtu.find("NumberOfPoints=\"" + std::to_string(n) + "\" NumberOfCells=\"2\""), std::string::npos);
          EXPECT_LT(vtu.find("velocity"), vtu.find("<CellData"));
          EXPECT_GT(vtu.find("stress"), vtu.find("<CellData"));
          for (const VtuField &field : grid.fields)
            {
              EXPECT_EQ(arrays.at(field.name).n_components, std::to_string(components));
              EXPECT_EQ(arrays.at(field.name).type, "Float32");
              EXPECT_TRUE(
                same_bits(arrays.at(field.name).as<float>(), std::vector<float>(field.values.begin(), field.values.end())));
            }
        }
  }

  // VTK's cells 9 and 28 have four and nine nodes: offsets point behind each cell's last one.
  TEST(VtuFile, CellsAreQuadrilaterals)
  {
    const Folder          folder;
    ContinuumSnapshotFile file(folder / "continuum");
    const Snapshot        s = example(2, 0.1, true);
    file.add(s);
    const auto nine = arrays_of(read_text(folder / "continuum/stage_0000.vtu"));
    EXPECT_EQ(nine.at("offsets").type, "Int32");
    EXPECT_EQ(nine.at("offsets").as<std::int32_t>(), (std::vector<std::int32_t>{9, 18, 27, 36}));
    EXPECT_EQ(nine.at("types").type, "UInt8");
    EXPECT_EQ(nine.at("types").as<std::uint8_t>(), std::vector<std::uint8_t>(4, 28));
    const auto connectivity = nine.at("connectivity").as<std::int32_t>();
    ASSERT_EQ(connectivity.size(), 36u);
    for (std::size_t k = 0; k < 36; ++k)
      EXPECT_EQ(connectivity[k], std::int32_t(s.cells[k / 9][k % 9]));
    EXPECT_EQ(nine.at("rotation").as<float>(), std::vector<float>(s.rotation.begin(), s.rotation.end()));
    EXPECT_EQ(nine.at("couple_stress").as<float>()[1], float(s.cell_state[0].couple_stress.y()));
    EXPECT_EQ(nine.at("couple_stress").as<float>()[2], 0);

    write_vtu(folder / "four.vtu", {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {0, 1, 2, 3}, VtkCell::quadrilateral, {}});
    const auto four = arrays_of(read_text(folder / "four.vtu"));
    EXPECT_EQ(four.at("offsets").as<std::int32_t>(), (std::vector<std::int32_t>{4}));
    EXPECT_EQ(four.at("types").as<std::uint8_t>(), std::vector<std::uint8_t>(1, 9));
  }

  TEST(VtuFile, FieldsOfAnotherLengthAreRefused)
  {
    const Folder folder;
    VtuGrid      grid{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {0, 1, 2, 3}, VtkCell::quadrilateral, {{"a", 1, {1, 2, 3}, true}}};
    EXPECT_THROW(write_vtu(folder / "a.vtu", grid), std::invalid_argument);
    EXPECT_FALSE(fs::exists(folder / "a.vtu"));
    grid.fields[0].values.push_back(4);
    write_vtu(folder / "a.vtu", grid);
    EXPECT_THROW(write_vtu(folder / "no/such/folder.vtu", grid), std::runtime_error);
  }
} // namespace
