// diptych: a table grows at its end and is taken up at any row
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/files/table_file.h"
#include "discrete/files/text_file.h"
#include "tests/discrete/panel/checkpoint_examples.h"

namespace
{
  struct Table : testing::Test
  {
    const Folder      folder;
    const std::string path = folder / "a.csv";
  };

  TEST_F(Table, RowsAreWrittenWhenItIsSaid)
  {
    TableFile table(path, "a,b");
    table.add("1,2");
    EXPECT_EQ(read_text(path), "a,b\n");
    table.flush();
    EXPECT_EQ(read_text(path), "a,b\n1,2\n");
    table.add("3,4"), table.add("5,6");
    table.flush();
    EXPECT_EQ(read_text(path), "a,b\n1,2\n3,4\n5,6\n");
    EXPECT_EQ(table.n_rows(), 3);
  }

  TEST_F(Table, ManyRowsDoNotWaitInMemory)
  {
    TableFile         table(path, "a,b");
    const std::string row(999, '1');
    for (int k = 0; k < 5000; ++k)
      table.add(row);
    EXPECT_GT(read_text(path).size(), 3u << 20);
    table.flush();
    EXPECT_EQ(read_text(path).size(), 4 + 5000u * 1000u);
  }

  TEST_F(Table, IsTakenUpAfterTheRowOfTheCheckpoint)
  {
    std::ofstream(path) << "a,b\n1,2\n3,4\n5,"; // killed while a row was written
    TableFile table(path, "a,b", 1);
    table.add("7,8");
    table.flush();
    EXPECT_EQ(read_text(path), "a,b\n1,2\n7,8\n");
  }

  TEST_F(Table, OtherColumnsOrFewerRowsAreRefused)
  {
    std::ofstream(path) << "a,b\n1,2\n3,4";
    EXPECT_THROW(TableFile(path, "a,c", 1), std::invalid_argument);
    EXPECT_THROW(TableFile(path, "a,b", 2), std::invalid_argument) << "the second row has no end";
    EXPECT_NO_THROW(TableFile(path, "a,b", 1));
    EXPECT_THROW(TableFile(path + "none", "a,b", 0), std::invalid_argument);
  }

  // Reading gives the written bits back, names of choices included.
  TEST_F(Table, RowsSurviveTheText)
  {
    Dice                    dice;
    std::vector<HistoryRow> written;
    TableFile               table(path, csv_header<HistoryRow>());
    for (int k = 0; k < 20; ++k)
      {
        written.push_back(random_row(dice));
        table.add(csv_line(written.back()));
      }
    table.flush();
    const std::vector<HistoryRow> read = read_rows<HistoryRow>(path);
    ASSERT_EQ(read.size(), written.size());
    for (std::size_t k = 0; k < read.size(); ++k)
      EXPECT_EQ(csv_line(read[k]), csv_line(written[k])); // the text is exact
    EXPECT_EQ(read[7].stress(0, 1), written[7].stress(0, 1));
    EXPECT_EQ(read[7].loading_variable, written[7].loading_variable);
  }

  TEST_F(Table, AWordThatIsNoValueOfItsColumnIsNamed)
  {
    Dice             dice;
    const HistoryRow row = random_row(dice);
    for (const auto &[from, to] :
         {std::pair{name_of(row.loading_variable), "sideways"}, std::pair{std::to_string(row.contacts), "many"}})
      {
        std::string       line  = csv_line(row);
        const std::size_t place = line.rfind(from);
        std::ofstream(path) << csv_header<HistoryRow>() << '\n'
                            << csv_line(row) << '\n'
                            << line.replace(place, from.size(), to) << '\n';
        expect_refused({path + ", line 3: column '", to}, [&] { read_rows<HistoryRow>(path); });
      }
  }
} // namespace
