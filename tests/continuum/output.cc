// diptych: what the continuum panel's files hold is what was given to them
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include <unistd.h>

#include <hdf5.h>

#include <gtest/gtest.h>

#include "continuum/output.h"

namespace
{
  using namespace diptych::continuum;
  namespace fs = std::filesystem;

  struct Folder
  {
    std::string path;

    explicit Folder(const std::string &name = "")
        : path((fs::path(testing::TempDir()) / ("diptych_output" + name + std::to_string(::getpid()))).string())
    {
      fs::remove_all(path);
      fs::create_directory(path);
    }
    ~Folder() { fs::remove_all(path); }
    std::string operator/(const std::string &name) const { return path + "/" + name; }
  };

  // No two values of a snapshot are alike, so that no two of its fields can be mistaken for each other.
  struct Numbers
  {
    int                                   n;
    double                                operator()() { return std::sin(++n) / 3; }
    void                                  operator()(double &value) { value = (*this)(); }
    template <int rows, int columns> void operator()(Eigen::Matrix<double, rows, columns> &m)
    {
      for (int k = 0; k < m.size(); ++k)
        m(k) = (*this)();
    }
  };

  // n x n cells of nine nodes on the unit square.
  Snapshot example(const unsigned int n, const double axial_strain, const bool cosserat)
  {
    Snapshot s;
    Numbers  next{int(1e6 * axial_strain)};
    s.axial_strain = axial_strain;
    next(s.time), next(s.area), next(s.lower_platen_force), next(s.upper_platen_force), next(s.mean_stress);
    const unsigned int side = 2 * n + 1;
    for (unsigned int k = 0; k < side * side; ++k)
      {
        s.position.emplace_back(double(k % side) / (2 * n), double(k / side) / (2 * n));
        s.displacement.emplace_back(next(), next());
        s.weight.push_back(next());
        if (cosserat)
          s.rotation.push_back(next());
      }
    for (unsigned int k = 0; k < n * n; ++k)
      {
        const unsigned int a = 2 * (k % n) + 2 * side * (k / n), b = a + side, c = b + side;
        s.cells.push_back({a, a + 2, c + 2, c, a + 1, b + 2, c + 1, b, b + 1});
        CellState cell;
        next(cell.stress), next(cell.strain), next(cell.plastic_strain), next(cell.couple_stress), next(cell.area);
        next(cell.equivalent_plastic_strain), next(cell.dissipation), next(cell.overstress);
        next(cell.share_zz_not_intermediate), next(cell.acoustic_determinant), next(cell.localisation_angle);
        s.cell_state.push_back(cell);
      }
    return s;
  }

  bool same_bits(const double a, const double b)
  {
    return std::memcmp(&a, &b, sizeof a) == 0;
  }
  template <int rows, int columns>
  bool same_bits(const Eigen::Matrix<double, rows, columns> &a, const Eigen::Matrix<double, rows, columns> &b)
  {
    return std::memcmp(a.data(), b.data(), sizeof a) == 0;
  }
  template <class T> bool same_bits(const std::vector<T> &a, const std::vector<T> &b)
  {
    return a.size() == b.size() &&
           std::equal(a.begin(), a.end(), b.begin(), [](const T &x, const T &y) { return same_bits(x, y); });
  }

  // A member added to CellState does not compile here: it needs a place in the files, too.
  void expect_same(const CellState &x, const CellState &y)
  {
    const auto &[stress, strain, plastic_strain, couple_stress, area, kappa, dissipation, overstress, zz, determinant, angle] = x;
    EXPECT_TRUE(same_bits(stress, y.stress)) << stress << "\n\n" << y.stress;
    EXPECT_TRUE(same_bits(strain, y.strain)) << strain << "\n\n" << y.strain;
    EXPECT_TRUE(same_bits(plastic_strain, y.plastic_strain)) << plastic_strain << "\n\n" << y.plastic_strain;
    EXPECT_TRUE(same_bits(couple_stress, y.couple_stress)) << couple_stress << "\n\n" << y.couple_stress;
    EXPECT_TRUE(same_bits(area, y.area));
    EXPECT_TRUE(same_bits(kappa, y.equivalent_plastic_strain));
    EXPECT_TRUE(same_bits(dissipation, y.dissipation));
    EXPECT_TRUE(same_bits(overstress, y.overstress));
    EXPECT_TRUE(same_bits(zz, y.share_zz_not_intermediate));
    EXPECT_TRUE(same_bits(determinant, y.acoustic_determinant));
    EXPECT_TRUE(same_bits(angle, y.localisation_angle));
  }

  void expect_same(const Snapshot &x, const Snapshot &y)
  {
    const auto &[axial_strain, time, position, displacement, rotation, weight, cells, states, lower, upper, mean_stress,
                 area] = x;
    EXPECT_TRUE(same_bits(axial_strain, y.axial_strain));
    EXPECT_TRUE(same_bits(time, y.time));
    EXPECT_TRUE(same_bits(position, y.position));
    EXPECT_TRUE(same_bits(displacement, y.displacement));
    EXPECT_TRUE(same_bits(rotation, y.rotation));
    EXPECT_TRUE(same_bits(weight, y.weight));
    EXPECT_EQ(cells, y.cells);
    EXPECT_TRUE(same_bits(lower, y.lower_platen_force));
    EXPECT_TRUE(same_bits(upper, y.upper_platen_force));
    EXPECT_TRUE(same_bits(mean_stress, y.mean_stress));
    EXPECT_TRUE(same_bits(area, y.area));
    ASSERT_EQ(states.size(), y.cell_state.size());
    for (std::size_t c = 0; c < states.size(); ++c)
      expect_same(states[c], y.cell_state[c]);
  }

  HistoryRow example_row(const int step, const double axial_strain)
  {
    HistoryRow r;
    Numbers    next{1000 * step};
    r.step         = step;
    r.axial_strain = axial_strain;
    next(r.stress_ratio), next(r.volumetric_strain), next(r.lower_platen_force), next(r.upper_platen_force);
    r.mean_stress.topLeftCorner<2, 2>() << next(), next(), next(), next();
    r.mean_stress(2, 2) = next();
    r.n_cells = 100 + step, r.n_unknowns = 200 + step, r.newton_iterations = 300 + step, r.linear_iterations = 400 + step;
    r.factorisations = 500 + step, r.cut_backs = 600 + step;
    next(r.plastic_share), next(r.unreliable_share), next(r.share_zz_not_intermediate), next(r.viscous_share);
    next(r.max_equivalent_plastic_strain), next(r.dissipation), next(r.least_acoustic_determinant), next(r.localisation_angle);
    next(r.point_cpu_s), next(r.assembly_cpu_s), next(r.solve_cpu_s), next(r.geometry_cpu_s);
    return r;
  }

  // A member added to HistoryRow does not compile here: it needs a column, too.
  void expect_same(const HistoryRow &x, const HistoryRow &y)
  {
    const auto &[step, axial_strain, stress_ratio, volumetric_strain, mean_stress, lower, upper, n_cells, n_unknowns, newton,
                 linear, factorisations, cut_backs, plastic, unreliable, zz, viscous, kappa, dissipation, determinant, angle,
                 point, assembly, solve, geometry] = x;
    EXPECT_EQ(step, y.step);
    EXPECT_TRUE(same_bits(axial_strain, y.axial_strain));
    EXPECT_TRUE(same_bits(stress_ratio, y.stress_ratio));
    EXPECT_TRUE(same_bits(volumetric_strain, y.volumetric_strain));
    EXPECT_TRUE(same_bits(mean_stress, y.mean_stress)) << mean_stress << "\n\n" << y.mean_stress;
    EXPECT_TRUE(same_bits(lower, y.lower_platen_force));
    EXPECT_TRUE(same_bits(upper, y.upper_platen_force));
    EXPECT_EQ(n_cells, y.n_cells);
    EXPECT_EQ(n_unknowns, y.n_unknowns);
    EXPECT_EQ(newton, y.newton_iterations);
    EXPECT_EQ(linear, y.linear_iterations);
    EXPECT_EQ(factorisations, y.factorisations);
    EXPECT_EQ(cut_backs, y.cut_backs);
    EXPECT_TRUE(same_bits(plastic, y.plastic_share));
    EXPECT_TRUE(same_bits(unreliable, y.unreliable_share));
    EXPECT_TRUE(same_bits(zz, y.share_zz_not_intermediate));
    EXPECT_TRUE(same_bits(viscous, y.viscous_share));
    EXPECT_TRUE(same_bits(kappa, y.max_equivalent_plastic_strain));
    EXPECT_TRUE(same_bits(dissipation, y.dissipation));
    EXPECT_TRUE(same_bits(determinant, y.least_acoustic_determinant));
    EXPECT_TRUE(same_bits(angle, y.localisation_angle));
    EXPECT_TRUE(same_bits(point, y.point_cpu_s));
    EXPECT_TRUE(same_bits(assembly, y.assembly_cpu_s));
    EXPECT_TRUE(same_bits(solve, y.solve_cpu_s));
    EXPECT_TRUE(same_bits(geometry, y.geometry_cpu_s));
  }

  std::string contents_of(const std::string &path)
  {
    std::ifstream in(path, std::ios::binary);
    EXPECT_TRUE(in) << path;
    return {std::istreambuf_iterator<char>(in), {}};
  }

  void put(const std::string &path, const std::string &contents)
  {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << contents;
  }

  template <class Action> void expect_error_naming(const std::vector<std::string> &names, Action &&action)
  {
    try
      {
        action();
        FAIL() << "no error";
      }
    catch (const std::runtime_error &error)
      {
        for (const std::string &name : names)
          EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << "no '" << name << "' in: " << error.what();
      }
  }

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

  TEST(Output, HistoryRowsComeBackBitByBit)
  {
    const Folder            folder;
    std::vector<HistoryRow> rows          = {example_row(0, 0), example_row(1, 0.1), example_row(2, 0.1 + 0.2)};
    rows[1].stress_ratio                  = std::nan("");
    rows[1].least_acoustic_determinant    = -std::numeric_limits<double>::infinity();
    rows[2].max_equivalent_plastic_strain = 5e-324;
    write_history(folder / "continuum.csv", rows);
    const std::vector<HistoryRow> read = read_history(folder / "continuum.csv");
    ASSERT_EQ(read.size(), rows.size());
    for (std::size_t k = 0; k < rows.size(); ++k)
      expect_same(rows[k], read[k]);
    // Columns that readers of older files know keep their places.
    const std::string first = "step,axial_strain,stress_ratio,volumetric_strain,sxx,sxy,syy,szz,lower_fx,lower_fy,upper_fx,"
                              "upper_fy,newton_iterations,linear_iterations,factorisations,cut_backs,plastic_share,"
                              "share_zz_not_intermediate,max_equivalent_plastic_strain,assembly_cpu_s,solve_cpu_s,";
    EXPECT_EQ(contents_of(folder / "continuum.csv").substr(0, first.size()), first);
  }

  TEST(Output, AWrongHistoryIsNamedWithLineAndColumn)
  {
    const Folder      folder;
    const std::string csv  = folder / "continuum.csv";
    const auto        read = [&] { (void)read_history(csv); };
    expect_error_naming({csv, "missing"}, read);
    write_history(csv, {example_row(0, 0), example_row(1, 0.25)});
    const std::string right = contents_of(csv);

    put(csv, std::regex_replace(right, std::regex("viscous_share"), "something"));
    expect_error_naming({csv, "viscous_share"}, read);
    put(csv, std::regex_replace(right, std::regex("\n1,0.25,"), "\n1,0.25x,"));
    expect_error_naming({csv, "line 3", "axial_strain", "0.25x"}, read);
    put(csv, right.substr(0, right.rfind(',')));
    expect_error_naming({csv, "line 3"}, read);
  }

  // What a run with these rows and stages leaves, told in the panel's order: a row, then the stage that it landed on.
  const std::vector<double> strains = {0, 0.005, 0.01, 0.015, 0.02, 0.025, 0.03}, stages = {0, 0.01, 0.02, 0.03};

  void run(ResultFiles &files, const int from_step, const int to_step)
  {
    for (int step = from_step; step < to_step; ++step)
      {
        files.add(example_row(step, strains[step]));
        for (unsigned int k = 0; k < stages.size(); ++k)
          if (stages[k] == strains[step])
            files.add(example(k + 1, stages[k], k < 2)); // refined from stage to stage
      }
    files.finish();
  }

  void expect_same_files(const Folder &a, const Folder &b)
  {
    std::set<std::string> names[2];
    for (const int k : {0, 1})
      for (const auto &entry : fs::recursive_directory_iterator((k ? a : b).path))
        names[k].insert(fs::relative(entry.path(), (k ? a : b).path).string());
    EXPECT_EQ(names[0], names[1]);
    for (const std::string &name : names[0])
      if (fs::path(name).extension() != ".h5" && name != "continuum")
        {
          EXPECT_EQ(contents_of(a / name), contents_of(b / name)) << name;
        }
    const auto x = read_snapshots(a / "continuum.h5"), y = read_snapshots(b / "continuum.h5");
    ASSERT_EQ(x.size(), y.size());
    for (std::size_t k = 0; k < x.size(); ++k)
      expect_same(x[k], y[k]);
  }

  // Killed after step 5 (or 3, 6), taken up again from the checkpoint of step 3: stage 0.02 and the rows 4, 5 are told again.
  TEST(Output, AnInterruptedRunLeavesTheFilesOfAnUninterruptedOne)
  {
    const Folder whole("whole");
    {
      ResultFiles files(whole.path);
      run(files, 0, 7);
    }
    for (const int killed_after : {4, 6, 7})
      {
        SCOPED_TRACE("steps before the kill: " + std::to_string(killed_after));
        const Folder folder("parts");
        {
          ResultFiles files(folder.path);
          run(files, 0, killed_after);
        }
        ResultFiles files(folder.path, strains[3] * (1 - 1e-13));
        EXPECT_EQ(read_history(folder / "continuum.csv").size(), 4u);
        EXPECT_EQ(read_stage_summaries(folder / "continuum.h5").size(), 2u);
        EXPECT_FALSE(fs::exists(folder / "continuum/stage_0002.vtu"));
        run(files, 4, 7);
        expect_same_files(folder, whole);
      }
  }

  // A run stopped by its user leaves a snapshot of where it ended, 0.015, which is no stage.
  TEST(Output, TheSnapshotOfAnEarlyEndIsDroppedWhenTheStagesAreGiven)
  {
    const Folder whole("whole"), folder("parts");
    {
      ResultFiles files(whole.path);
      run(files, 0, 7);
    }
    {
      ResultFiles files(folder.path);
      run(files, 0, 4);
      files.add(example(4, strains[3], true));
    }
    {
      ResultFiles files(folder.path, strains[3]);
      EXPECT_EQ(read_stage_summaries(folder / "continuum.h5").size(), 3u) << "not to be told from a stage";
    }
    ResultFiles files(folder.path, strains[3], stages);
    run(files, 4, 7);
    expect_same_files(folder, whole);
  }

  TEST(Output, AResumeBeforeTheFirstStageKeepsNone)
  {
    const Folder folder;
    {
      ResultFiles files(folder.path);
      files.add(example_row(0, 0));
      files.add(example_row(1, 0.005));
      files.add(example(1, 0.01, true));
    }
    ResultFiles files(folder.path, 0.005);
    EXPECT_FALSE(fs::exists(folder / "continuum.h5"));
    files.add(example(2, 0.01, false));
    const auto read = read_snapshots(folder / "continuum.h5");
    ASSERT_EQ(read.size(), 1u);
    expect_same(read[0], example(2, 0.01, false));
    EXPECT_EQ(read_history(folder / "continuum.csv").size(), 2u);
  }

  TEST(Output, AResumeWithoutHistoryOrFromADamagedFileIsRefusedByName)
  {
    const Folder folder;
    expect_error_naming({folder / "continuum.csv"}, [&] { ResultFiles(folder.path, 0.1); });
    {
      ResultFiles files(folder.path);
      run(files, 0, 7);
    }
    const std::string h5 = contents_of(folder / "continuum.h5");
    put(folder / "continuum.h5", h5.substr(0, h5.size() / 2));
    expect_error_naming({folder / "continuum.h5"}, [&] { ResultFiles(folder.path, 0.1); });
  }

  // Room that was reserved and not needed is given back: 10 kB of values do not make a file of megabytes.
  TEST(Output, AFileIsNotLargerThanItsContents)
  {
    const Folder folder;
    append_to_hdf5(folder / "continuum.h5", example(2, 0, true), 0);
    EXPECT_LT(fs::file_size(folder / "continuum.h5"), 100000u);
  }

  // Rows are in the file as soon as they are told: a checkpoint that follows relies on them.
  TEST(Output, ARowIsInTheFileBeforeTheNextStage)
  {
    const Folder folder;
    ResultFiles  files(folder.path);
    files.add(example_row(0, 0));
    EXPECT_EQ(read_history(folder / "continuum.csv").size(), 1u);
  }
} // namespace
