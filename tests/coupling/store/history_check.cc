// diptych: a table is that of the snapshots beside it, or it is refused
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/store/history_check.h"
#include "continuum/history.h"
#include "tests/coupling/comparison/example_results.h"
#include "tests/coupling/store/examples.h"

namespace
{
  using namespace diptych::coupling;
  using diptych::discrete::HistoryRow;
  using diptych::discrete::Snapshot;

  using Rows = std::vector<HistoryRow>;

  // Forty rows to 2 %, stages at 1 % (row 19) and 2 % (row 39).
  Rows forty_rows()
  {
    return synthetic::example_rows_of<HistoryRow>(1. / 3, -0.01);
  }

  std::vector<Snapshot> three_snapshots()
  {
    std::vector<Snapshot> snapshots(3);
    snapshots[1].progress = 0.01, snapshots[2].progress = 0.02;
    return snapshots;
  }

  void expect_history_refused(const std::function<void(Rows &)> &change, const std::string &told, const bool finished = true)
  {
    Rows rows = forty_rows();
    change(rows);
    files::expect_refused({"mine.csv", told}, [&] { check_history(rows, three_snapshots(), {"mine.csv", finished, false}); });
  }

  TEST(HistoryCheck, ATableThatLacksWhatAFinishedRunWroteIsRefused)
  {
    EXPECT_NO_THROW(check_history(forty_rows(), three_snapshots(), {"mine.csv", true, false}));
    expect_history_refused([](Rows &rows) { rows.resize(20); }, "0.02 of snapshot 2"); // cut at a line's end
    expect_history_refused([](Rows &rows) { rows.erase(rows.begin() + 19); }, "0.01 of snapshot 1");
    expect_history_refused([](Rows &rows) { rows.pop_back(); }, "0.02 of snapshot 2");
    expect_history_refused([](Rows &rows) { std::reverse(rows.begin(), rows.end()); }, "line 3");
    expect_history_refused([](Rows &rows) { std::swap(rows[4], rows[5]); }, "line 7");
    expect_history_refused([](Rows &rows) { rows.push_back(rows.back()), ++rows.back().step, rows.back().progress = 0.03; },
                           "goes on");
  }

  // With an interval of four steps every fourth has a row, and the last of each stage.
  TEST(HistoryCheck, ARowAtTheEndOfEachStageIsEnough)
  {
    Rows rows;
    for (const HistoryRow &row : forty_rows())
      if (row.step % 4 == 0)
        rows.push_back(row);
    EXPECT_NO_THROW(check_history(rows, three_snapshots(), {"mine.csv", true, false}));
  }

  // It was stopped, or did not converge, at a step that has no row; killed, it has rows after its last snapshot.
  TEST(HistoryCheck, OfWhatDidNotFinishTheLastSnapshotMayStandAlone)
  {
    Rows rows = forty_rows();
    rows.resize(30);
    EXPECT_NO_THROW(check_history(rows, three_snapshots(), {"mine.csv", false, false}));
    std::vector<Snapshot> killed = three_snapshots();
    killed.pop_back();
    EXPECT_NO_THROW(check_history(forty_rows(), killed, {"mine.csv", false, false}));
    expect_history_refused([](Rows &r) { r.resize(10); }, "0.01 of snapshot 1", false);
  }

  TEST(HistoryCheck, NumbersAreFiniteUnlessTheirMeaningSaysOtherwise)
  {
    for (const double bad : {double(NAN), double(INFINITY)})
      {
        expect_history_refused([&](Rows &rows) { rows[7].time = bad; }, "line 9: column 'time'");
        expect_history_refused([&](Rows &rows) { rows[7].axial_strain = bad; }, "line 9: column 'axial_strain'");
        expect_history_refused([&](Rows &rows) { rows[7].progress = bad; }, "line 9: column 'progress'");
      }
    Rows rows            = forty_rows();
    rows[7].stress_ratio = NAN; // where nothing carries a stress
    EXPECT_NO_THROW(check_history(rows, three_snapshots(), {"mine.csv", true, false}));
    rows[7].time = rows[7].energy_residual = NAN; // another code tells less
    EXPECT_NO_THROW(check_history(rows, three_snapshots(), {"mine.csv", true, true}));
    EXPECT_THROW(check_history(rows, three_snapshots(), {"mine.csv", true, false}), std::invalid_argument);
  }

  // Both tables hold NaN in the one column whose description says so, whatever the words of the others.
  TEST(HistoryCheck, OnlyTheStressRatioMayBeNan)
  {
    const auto named = [](const auto &row) {
      std::vector<std::string> names;
      visit_columns(row, [&](const std::string &name, const auto &, const char *, const auto &meaning) {
        if (history::may_be_nan(meaning))
          names.push_back(name);
      });
      return names;
    };
    const std::vector<std::string> expected{"stress_ratio"};
    EXPECT_EQ(named(HistoryRow()), expected);
    EXPECT_EQ(named(diptych::continuum::HistoryRow()), expected);
  }
} // namespace
