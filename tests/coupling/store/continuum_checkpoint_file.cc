// diptych: a continuum run put down in a file comes back bit by bit, or is refused by name
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/store/continuum_checkpoint_file.h"

#include <hdf5.h>

#include "tests/coupling/store/examples.h"

namespace
{
  using namespace diptych::coupling::files;

  // Every entry another value.
  struct Fill
  {
    Numbers next{0};

    void operator()(const char *, double &value) { value = next(); }
    void operator()(const char *, int &value) { value = ++next.n; }
    void operator()(const char *, bool &value) { value = !value; }
    void operator()(const char *, Eigen::Vector2d &value) { next(value); }
    void operator()(const char *, std::optional<double> &value) { value = next(); }
    void operator()(const char *, std::vector<double> &values) { values = {next(), -0., 5e-324, 1e308, -1e-308}; }
    void operator()(const char *, std::vector<std::string> &names) { names = {"0_0:", "0_1:3", "12_2:01"}; }
    template <class T> void operator()(const char *name, std::vector<std::vector<T>> &lists)
    {
      lists.resize(2);
      (*this)(name, lists[1]);
    }
  };

  ContinuumCheckpoint example_checkpoint()
  {
    ContinuumCheckpoint c;
    continuum::visit_entries(c.panel, Fill());
    c.panel.values_per_cell = 4;
    c.panel.values          = {1. / 3, -0., std::nan("7"), 5e-324, 1e308, -std::numeric_limits<double>::infinity(),
                               0.1,    0.,  -1e-300,       2,      -3,    std::nextafter(1., 2.)};
    c.n_rows                = 17;
    c.scene                 = "law = 'cosserat_mohr_coulomb'\nfriction = '45'";
    c.sample                = "0123abcd";
    return c;
  }

  // The bytes of every entry, by its place and name.
  struct Bytes
  {
    std::vector<std::pair<std::string, std::string>> entries;

    template <class T> void operator()(const std::string &name, const T &value)
    {
      entries.emplace_back(name, std::string(reinterpret_cast<const char *>(&value), sizeof value));
    }
    void operator()(const std::string &name, const std::optional<double> &value)
    {
      value ? (*this)(name, *value) : (*this)(name, false);
    }
    void                    operator()(const std::string &name, const std::string &value) { entries.emplace_back(name, value); }
    template <class T> void operator()(const std::string &name, const std::vector<T> &values)
    {
      for (const T &value : values)
        (*this)(name, value);
      (*this)(name, values.size());
    }
  };

  void expect_same_checkpoint(const ContinuumCheckpoint &a, const ContinuumCheckpoint &b)
  {
    EXPECT_EQ(a.scene, b.scene);
    EXPECT_EQ(a.sample, b.sample);
    EXPECT_EQ(a.n_rows, b.n_rows);
    Bytes x, y;
    continuum::visit_entries(a.panel, [&](const char *name, const auto &value) { x(name, value); });
    continuum::visit_entries(b.panel, [&](const char *name, const auto &value) { y(name, value); });
    EXPECT_TRUE(x.entries == y.entries);
  }

  void expect_refusal_naming(const std::string &path, const std::string &reason)
  {
    expect_refused({path, reason}, [&] { (void)read_continuum_checkpoint(path); });
  }

  void relink(const std::string &path, const std::string &from, const std::string &to)
  {
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    ASSERT_GE(H5Lmove(file, from.c_str(), file, to.c_str(), H5P_DEFAULT, H5P_DEFAULT), 0);
    H5Fclose(file);
  }

  TEST(ContinuumCheckpointFile, ComesBackBitByBit)
  {
    const Folder              folder;
    const ContinuumCheckpoint c = example_checkpoint();
    write_continuum_checkpoint(folder / "checkpoint.h5", c);
    expect_same_checkpoint(read_continuum_checkpoint(folder / "checkpoint.h5"), c);
    EXPECT_FALSE(fs::exists(folder / "checkpoint.h5.part"));
    ContinuumCheckpoint none = c;
    none.panel.localisation_progress.reset();
    write_continuum_checkpoint(folder / "checkpoint.h5", none);
    expect_same_checkpoint(read_continuum_checkpoint(folder / "checkpoint.h5"), none);
  }

  TEST(ContinuumCheckpointFile, AnEmptyOneAndManyCellsComeBack)
  {
    const Folder      folder;
    const std::string file = folder / "checkpoint.h5";
    write_continuum_checkpoint(file, {});
    expect_same_checkpoint(read_continuum_checkpoint(file), {});

    ContinuumCheckpoint many = example_checkpoint(); // more rows than one checksummed piece of 4096
    many.panel.cells.clear();
    many.panel.values.clear();
    for (int k = 0; k < 10000; ++k)
      {
        many.panel.cells.push_back(std::to_string(100000 + k) + "_0:");
        for (int i = 0; i < many.panel.values_per_cell; ++i)
          many.panel.values.push_back(std::sin(k + 0.1 * i));
      }
    write_continuum_checkpoint(file, many);
    expect_same_checkpoint(read_continuum_checkpoint(file), many);
  }

  TEST(ContinuumCheckpointFile, MissingAndForeignFilesAreRefusedByName)
  {
    const Folder      folder;
    const std::string file = folder / "checkpoint.h5";
    expect_refusal_naming(file, "missing");
    write_text(file, "step,axial_strain\n");
    expect_refusal_naming(file, "not an HDF5 file");
    write_continuum_checkpoint(file, example_checkpoint());
    relink(file, "format", "other");
    expect_refusal_naming(file, "diptych continuum checkpoint");
    relink(file, "scene", "format"); // another text there
    expect_refusal_naming(file, "diptych continuum checkpoint");
  }

  TEST(ContinuumCheckpointFile, AMissingPartIsNamed)
  {
    const Folder      folder;
    const std::string file = folder / "checkpoint.h5";
    for (const std::string name : {"scene", "values", "cells", "divisions", "factorised_matrix"})
      {
        write_continuum_checkpoint(file, example_checkpoint());
        relink(file, name, "elsewhere");
        expect_refusal_naming(file, name);
      }
  }

  TEST(ContinuumCheckpointFile, MatricesAndCountsAreFinite)
  {
    const Folder                                                     folder;
    const std::string                                                file      = folder / "checkpoint.h5";
    const std::pair<const char *, void (*)(continuum::Checkpoint &)> changes[] = {
      {"factorised_matrix", [](continuum::Checkpoint &c) { c.factorised_matrix[0] = INFINITY; }},
      {"rigid_modes/1", [](continuum::Checkpoint &c) { c.rigid_modes[1][0] = NAN; }},
      {"progress", [](continuum::Checkpoint &c) { c.progress = NAN; }},
      {"upper_platen_force", [](continuum::Checkpoint &c) { c.platen_force[1].y() = NAN; }},
      {"localisation_progress", [](continuum::Checkpoint &c) { c.localisation_progress = NAN; }}};
    for (const auto &[name, change] : changes)
      {
        ContinuumCheckpoint c = example_checkpoint();
        change(c.panel);
        write_continuum_checkpoint(file, c);
        expect_refusal_naming(file, "'" + std::string(name) + "' holds a number that is not finite");
      }
  }

  TEST(ContinuumCheckpointFile, AnArrayOfAnotherLengthIsNamed)
  {
    const Folder      folder;
    const std::string file = folder / "checkpoint.h5";
    for (const std::string name : {"factorised_matrix", "rigid_modes/1", "divisions/1"})
      {
        write_continuum_checkpoint(file, example_checkpoint());
        const hid_t handle = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
        const hid_t array = H5Dopen2(handle, name.c_str(), H5P_DEFAULT), attribute = H5Aopen(array, "length", H5P_DEFAULT);
        double      length = 0;
        ASSERT_GE(H5Aread(attribute, H5T_NATIVE_DOUBLE, &length), 0);
        EXPECT_GT(length, 1);
        length -= 1;
        ASSERT_GE(H5Awrite(attribute, H5T_NATIVE_DOUBLE, &length), 0);
        H5Aclose(attribute), H5Dclose(array), H5Fclose(handle);
        expect_refusal_naming(file, name);
      }
  }

  TEST(ContinuumCheckpointFile, ContentsThatContradictEachOtherAreNotWritten)
  {
    const Folder        folder;
    ContinuumCheckpoint short_of_a_value = example_checkpoint();
    short_of_a_value.panel.values.pop_back();
    EXPECT_THROW(write_continuum_checkpoint(folder / "checkpoint.h5", short_of_a_value), std::invalid_argument);
    EXPECT_FALSE(fs::exists(folder / "checkpoint.h5"));
  }
} // namespace
