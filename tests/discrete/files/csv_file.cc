// diptych: a table of numbers is read exactly or refused by name, grows at its end and is taken up at any row
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cfloat>
#include <clocale>

#include <sys/stat.h>

#include "discrete/files/csv_file.h"
#include "discrete/files/text_file.h"
#include "discrete/files/table_file.h"
#include "tests/common.h"
#include "tests/discrete/panel/checkpoint_examples.h"

namespace
{
  using namespace diptych::discrete;
  using namespace diptych::tests;

  const Folder      tables;
  const std::string path = tables / "table.csv";

  CsvTable read(const std::string &text, const CsvHeader &header = {{"a", "b"}, {"c"}})
  {
    write_text(path, text);
    return read_csv(path, header);
  }

  std::string complaint_about(const std::string &text)
  {
    return complaint(path, [&] { read(text); });
  }

  TEST(CsvFile, ColumnsInAnyOrderBlanksCommentsAndEmptyLinesAreUnderstood)
  {
    const CsvTable table = read("# made by hand\n\n b , a \r\n 1.5,-2e-3\n\t\n# between\n+4 , .5\n");
    ASSERT_EQ(table.rows.size(), 2u);
    EXPECT_EQ(table.at(0, "a"), -2e-3);
    EXPECT_EQ(table.at(0, "b"), 1.5);
    EXPECT_EQ(table.at(1, "a"), 0.5);
    EXPECT_EQ(table.at(1, "b"), 4);
    EXPECT_FALSE(table.find("c"));
    // Lines are those of the file: header in 3, numbers in 4 and 7.
    EXPECT_EQ(table.line, (std::vector<int>{4, 7}));
  }

  TEST(CsvFile, AByteOrderMarkAndAMissingLastNewlineDoNoHarm)
  {
    EXPECT_EQ(read("\xEF\xBB\xBF"
                   "a,b\n1,2")
                .at(0, "a"),
              1);
  }

  TEST(CsvFile, FurtherColumnsAreReadWhereTheyAreAllowed)
  {
    EXPECT_EQ(read("a,z,b\n1,2,3\n", {{"a", "b"}, {}, true}).at(0, "z"), 2);
  }

  TEST(CsvFile, EveryFaultOfHeaderAndRowsIsNamed)
  {
    const std::pair<const char *, const char *> faults[] = {
      {"", ": is empty; its first line must name the columns"},
      {"# only a comment\n\n", ": is empty; its first line must name the columns"},
      {"a,b\n# nothing\n", ": holds no line of numbers below the header; allowed: 1 or more"},
      {"# x\na,c\n1,2\n", ", line 2: column 'b' is missing"},
      {"a,b,bb\n1,2,3\n", ", line 1: unknown column 'bb'; the nearest is 'b'"},
      {"a,b,a\n1,2,3\n", ", line 1: column 'a' occurs twice"},
      {"a,,b\n1,2,3\n", ", line 1: column 2 has no name"},
      {"1,2\n3,4\n", ", line 1: '1' is a number, not a column's name; the header line is missing"},
      {"a,b\n1,2\n3\n", ", line 3: 1 fields; allowed: 2, as many as the header line names"},
      {"a,b\n1,2,\n", ", line 2: 3 fields; allowed: 2, as many as the header line names"},
      {"a,b\n1,abc\n", ", line 2: column 'b' = 'abc' is not a number"},
      {"a,b\n1,2x\n", ", line 2: column 'b' = '2x' is not a number"},
      {"a,b\n1,\n", ", line 2: column 'b' = '' is not a number"},
      {"a,b\n+-1,2\n", ", line 2: column 'a' = '+-1' is not a number"},
      {"a,b\nnan,2\n", ", line 2: column 'a' = 'nan' is not finite"},
      {"a,b\n1,-inf\n", ", line 2: column 'b' = '-inf' is not finite"}};
    for (const auto &[text, told] : faults)
      EXPECT_EQ(complaint_about(text), told);
    EXPECT_EQ(complaint_about("a,b\n1,1e999\n").find(", line 2: column 'b' = '1e999' is beyond double precision"), 0u);
  }

  TEST(CsvFile, AMissingFileAndAFolderAreNamed)
  {
    for (const std::string &name : {path + ".absent", testing::TempDir()})
      EXPECT_EQ(refusal([&] { read_csv(name, {{"a"}}); }).find(name + ": cannot be"), 0u);
  }

  TEST(CsvFile, WrittenNumbersReadBackWithTheSameBits)
  {
    const std::vector<double> values = {0.1, 1. / 3, -M_PI, 1e-300, 123456789.123456789, std::nextafter(1., 2.), DBL_MAX, 5e-324};
    std::string               text   = "a,b\n";
    for (const double value : values)
      text += exact_text(value) + "," + exact_text(-value) + "\n";
    const CsvTable table = read(text);
    for (std::size_t k = 0; k < values.size(); ++k)
      {
        EXPECT_EQ(table.at(k, "a"), values[k]);
        EXPECT_EQ(table.at(k, "b"), -values[k]);
      }
    EXPECT_TRUE(std::signbit(read("a,b\n-0,0\n").at(0, "a")));
  }

  // In a locale with a decimal comma strtod and printf would take 1.5 for 1. Where none is installed this says nothing.
  TEST(CsvFile, TheLocaleDoesNotMatter)
  {
    const std::string before = std::setlocale(LC_ALL, nullptr);
    for (const char *locale : {"de_DE.UTF-8", "fr_FR.UTF-8"})
      std::setlocale(LC_ALL, locale);
    EXPECT_EQ(read("a,b\n1.5,2\n").at(0, "a"), 1.5);
    EXPECT_EQ(exact_text(1.5), "1.5");
    std::setlocale(LC_ALL, before.c_str());
  }

  // read_csv calls check_stop before its 1024th line, too, and not again after it has thrown.
  TEST(CsvFile, EndsBetweenItsLinesWhenAsked)
  {
    std::string text = "a,b\n";
    for (int row = 0; row < 5000; ++row)
      text += "1,2\n";
    write_text(path, text);
    for (const int last : {1, 2, 3, 7})
      {
        struct Stopped
        {};
        int        calls      = 0;
        const auto check_stop = [&] {
          if (++calls == last)
            throw Stopped();
        };
        EXPECT_THROW(read_csv(path, {{"a", "b"}}, check_stop), Stopped) << last;
        EXPECT_EQ(calls, last);
      }
    EXPECT_EQ(read_csv(path, {{"a", "b"}}, [] {}).rows.size(), 5000u);
  }

  // Opening a FIFO waits for somebody who writes into it, and a device may have no end.
  TEST(TextFile, APipeOrADeviceIsRefusedByName)
  {
    const std::string pipe = path + ".fifo";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    for (const std::string &file : {pipe, std::string("/dev/zero")})
      expect_refused({file + ": is not a regular file"}, [&] { (void)read_input(file, 1000); });
  }

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
