// diptych: what the continuum panel's files hold is what was given to them
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/store/continuum_snapshot_file.h"

#include <hdf5.h>

#include "discrete/files/table_file.h"
#include "tests/coupling/store/examples.h"

namespace
{
  using namespace diptych::coupling::files;

  TEST(ContinuumSnapshotFile, EveryFieldOfEveryStageComesBackBitByBit)
  {
    const Folder folder;
    Snapshot     odd                  = example(1, 0.1, true);
    odd.cell_state[0].overstress      = -0.;
    odd.rotation[3]                   = 5e-324;
    const std::vector<Snapshot> given = {example(2, 0, true), odd, example(3, 0.2, false)}; // another mesh at every stage
    ContinuumSnapshotFile       file(folder / "continuum");
    for (const Snapshot &s : given)
      file.add(s);
    for (const bool closed : {false, true})
      {
        if (closed)
          file.close();
        const std::vector<Snapshot> read = read_continuum_snapshots(folder / "continuum.h5");
        ASSERT_EQ(read.size(), given.size());
        for (std::size_t k = 0; k < given.size(); ++k)
          {
            SCOPED_TRACE("stage " + std::to_string(k));
            expect_same(given[k], read[k]);
          }
        EXPECT_TRUE(read[2].rotation.empty());
      }
    EXPECT_EQ(count_continuum_snapshots(folder / "continuum.h5"), 3u);
    EXPECT_EQ(count_continuum_snapshots(folder / "none.h5"), 0u);
    for (const auto &entry : fs::recursive_directory_iterator(folder.path))
      EXPECT_NE(entry.path().extension(), ".part") << entry.path();
  }

  // A file of an older version is one without some of the datasets.
  TEST(ContinuumSnapshotFile, AMissingDatasetIsNamedWithFileAndStage)
  {
    const Folder      folder;
    const std::string h5 = folder / "continuum.h5";
    for (const std::string name : {"cells/plastic_strain", "cells/nodes", "nodes/weight", "cells/acoustic_determinant"})
      {
        ContinuumSnapshotFile stages(folder / "continuum");
        stages.add(example(1, 0, true));
        stages.add(example(2, 0.1, true));
        stages.close();
        const hid_t file = H5Fopen(h5.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
        ASSERT_GE(H5Ldelete(file, ("stage_0001/" + name).c_str(), H5P_DEFAULT), 0);
        H5Fclose(file);
        expect_refused({h5, "stage_0001", name}, [&] { (void)read_continuum_snapshots(h5); });
      }
  }

  TEST(ContinuumSnapshotFile, CutShortDamagedForeignAndMissingFilesAreNamed)
  {
    const Folder      folder;
    const std::string h5   = folder / "continuum.h5";
    const auto        read = [&] { (void)read_continuum_snapshots(h5); };
    expect_refused({h5, "missing"}, read);
    write_text(h5, "no HDF5");
    expect_refused({h5}, read);

    const Snapshot        s = example(2, 0, true);
    ContinuumSnapshotFile file(folder / "continuum");
    file.add(s);
    file.close();
    const std::string whole = read_text(h5);
    for (const double share : {0., 0.2, 0.99})
      {
        write_text(h5, whole.substr(0, std::size_t(share * whole.size())));
        expect_refused({h5}, read);
      }

    std::string       damaged = whole;
    const std::size_t place   = damaged.find(
        std::string(reinterpret_cast<const char *>(&s.cell_state[1].dissipation), sizeof(double)));
    ASSERT_NE(place, std::string::npos);
    damaged[place] ^= 1;
    write_text(h5, damaged);
    expect_refused({h5, "stage_0000", "cells/dissipation"}, read);

    H5Fclose(H5Fcreate(h5.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
    expect_refused({h5, "stage_0000"}, read);
  }

  TEST(ContinuumSnapshotFile, WhatIsNoSnapshotIsNotWritten)
  {
    const Folder          folder;
    ContinuumSnapshotFile file(folder / "continuum");
    file.add(example(1, 0, true));
    const std::string before = read_text(folder / "continuum.h5");
    for (const int which : {0, 1, 2})
      {
        Snapshot s = example(1, 0.1, true);
        which == 0 ? s.rotation.pop_back() : which == 1 ? s.displacement.pop_back() : s.cell_state.pop_back();
        EXPECT_THROW(file.add(s), std::invalid_argument) << which;
      }
    EXPECT_EQ(read_text(folder / "continuum.h5"), before);
    EXPECT_FALSE(fs::exists(folder / "continuum/stage_0001.vtu"));
  }

  // A number that is none is found where it is read, not as a picture with holes.
  TEST(ContinuumSnapshotFile, WhatIsNotFiniteIsRefusedByName)
  {
    const Folder          folder;
    ContinuumSnapshotFile file(folder / "continuum");
    Snapshot              s      = example(1, 0, true);
    s.cell_state[0].stress(1, 0) = std::nan("");
    file.add(s);
    expect_refused({folder / "continuum.h5", "stage_0000", "cells/stress"},
                   [&] { (void)read_continuum_snapshots(folder / "continuum.h5"); });
  }

  // One run writes all stages. The other is killed after its second stage and continues from there.
  TEST(ContinuumSnapshotFile, AnInterruptedRunLeavesTheFilesOfAnUninterruptedOne)
  {
    const auto   stage = [](const int k) { return example(k + 1, 0.01 * k, k < 2); }; // refined from stage to stage
    const Folder whole, parts;
    {
      ContinuumSnapshotFile file(whole / "continuum");
      for (const int k : {0, 1, 2, 3})
        file.add(stage(k));
      file.close();
    }
    {
      ContinuumSnapshotFile file(parts / "continuum");
      for (const int k : {0, 1, 3}) // the last of an early end
        file.add(stage(k));
    }
    ContinuumSnapshotFile file(parts / "continuum", 2);
    EXPECT_FALSE(fs::exists(parts / "continuum/stage_0002.vtu"));
    for (const int k : {2, 3})
      file.add(stage(k));
    file.close();
    std::set<std::string> names[2];
    for (const int k : {0, 1})
      for (const auto &entry : fs::recursive_directory_iterator((k ? parts : whole).path))
        names[k].insert(fs::relative(entry.path(), (k ? parts : whole).path).string());
    EXPECT_EQ(names[0], names[1]);
    for (const std::string &name : names[0])
      if (fs::path(name).extension() != ".h5" && name != "continuum")
        {
          EXPECT_EQ(read_text(whole / name), read_text(parts / name)) << name;
        }
    const auto x = read_continuum_snapshots(whole / "continuum.h5"), y = read_continuum_snapshots(parts / "continuum.h5");
    ASSERT_EQ(x.size(), y.size());
    for (std::size_t k = 0; k < x.size(); ++k)
      expect_same(x[k], y[k]);
    EXPECT_THROW(ContinuumSnapshotFile(parts / "continuum", 9), std::invalid_argument);
  }

  // Room that was reserved and not needed is given back: 10 kB of values do not make a file of megabytes.
  TEST(ContinuumSnapshotFile, IsNotLargerThanItsContents)
  {
    const Folder          folder;
    ContinuumSnapshotFile file(folder / "continuum");
    file.add(example(2, 0, true));
    file.close();
    EXPECT_LT(fs::file_size(folder / "continuum.h5"), 100000u);
  }

  // Unit and meaning of an array stand beside it.
  TEST(ContinuumSnapshotFile, ArraysSayWhatTheyAre)
  {
    const Folder          folder;
    ContinuumSnapshotFile file(folder / "continuum");
    file.add(example(1, 0.1, true));
    const discrete::Hdf5Reader h5(folder / "continuum.h5");
    EXPECT_EQ(h5.text_attribute("stage_0000/cells/stress", "unit"), "pressure");
    EXPECT_NE(h5.text_attribute("stage_0000/nodes/displacement", "meaning"), "");
    EXPECT_EQ(h5.text_attribute("stage_0000", "walk"), "shear_strain");
  }

  TEST(ContinuumHistory, RowsComeBackBitByBit)
  {
    const Folder            folder;
    std::vector<HistoryRow> rows(3);
    Numbers                 next{0};
    for (HistoryRow &row : rows)
      visit_columns(row, [&](const char *, auto &value, const char *, const char *) { next(value); });
    rows[2].max_equivalent_plastic_strain = 5e-324;
    rows[1].loading_variable              = continuum::LoadingVariable::time;
    {
      discrete::TableFile table(folder / "continuum.csv", discrete::csv_header<HistoryRow>());
      for (const HistoryRow &row : rows)
        table.add(discrete::csv_line(row));
      table.flush();
    }
    const auto read = discrete::read_rows<HistoryRow>(folder / "continuum.csv");
    ASSERT_EQ(read.size(), rows.size());
    for (std::size_t k = 0; k < rows.size(); ++k)
      {
        EXPECT_EQ(discrete::csv_line(read[k]), discrete::csv_line(rows[k]));
        EXPECT_TRUE(same_bits(read[k].mean_stress, rows[k].mean_stress)) << "every entry of the tensor has a column";
        EXPECT_TRUE(same_bits(read[k].upper_platen_force, rows[k].upper_platen_force));
      }
    // Columns that readers of older files know keep their places.
    const std::string first = "step,axial_strain,stress_ratio,volumetric_strain,sxx,sxy,syy,szz,lower_fx,lower_fy,upper_fx,"
                              "upper_fy,newton_iterations,linear_iterations,factorisations,cut_backs,plastic_share,"
                              "share_zz_not_intermediate,max_equivalent_plastic_strain,assembly_cpu_s,solve_cpu_s,";
    EXPECT_EQ(read_text(folder / "continuum.csv").substr(0, first.size()), first);
  }
} // namespace
