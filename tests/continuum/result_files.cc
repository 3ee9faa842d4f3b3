// diptych: the continuum's history, and the files of a run that was interrupted
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>
#include <limits>
#include <regex>
#include <set>

#include <gtest/gtest.h>

#include "tests/continuum/output_examples.h"

namespace
{
  using namespace diptych::continuum;
  using namespace diptych::continuum::tests::output;

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
