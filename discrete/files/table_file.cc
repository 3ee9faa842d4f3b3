// diptych: a table of numbers that grows row by row
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/files/table_file.h"

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include "discrete/files/text_file.h"

namespace diptych::discrete
{
  namespace
  {
    constexpr std::size_t most_waiting = 1 << 20; // bytes
  }

  TableFile::TableFile(std::string path, const std::string &header)
      : path(std::move(path))
  {
    write_text(this->path, header + '\n');
  }

  void check_table(const std::string &path, const std::string &header, const long n_rows)
  {
    require_regular_file(path);
    std::ifstream in(path);
    std::string   line;
    if (!std::getline(in, line) || line != header)
      throw std::invalid_argument(path + ": is missing or has other columns than this version writes");
    long found = 0;
    while (std::getline(in, line) && !in.eof()) // a last line without its end is incomplete
      ++found;
    if (found < n_rows)
      throw std::invalid_argument(path + ": holds " + std::to_string(found) + " rows, not the " + std::to_string(n_rows) +
                                  " that the checkpoint beside it goes on from");
  }

  TableFile::TableFile(std::string path_, const std::string &header, const long n_rows)
      : path(std::move(path_)),
        n(n_rows)
  {
    check_table(path, header, n);
    keep_lines(path, std::size_t(n) + 1);
  }

  void TableFile::add(const std::string &line)
  {
    waiting += line + '\n';
    ++n;
    if (waiting.size() > most_waiting)
      flush();
  }

  void TableFile::flush()
  {
    if (waiting.empty())
      return;
    append_text(path, waiting);
    waiting.clear();
  }

  std::size_t WordTable::place_of(const std::string &column) const
  {
    const auto found = std::find(columns.begin(), columns.end(), column);
    if (found == columns.end())
      throw std::invalid_argument(path + ", line 1: column '" + column + "' is missing; was it written by another version?");
    return std::size_t(found - columns.begin());
  }

  void WordTable::refuse(const std::size_t row, const std::string &column, const std::string &value) const
  {
    throw std::invalid_argument(path + ", line " + std::to_string(row + 2) + ": column '" + column + "' = '" + value +
                                "' is not a value of that column");
  }

  WordTable read_words(const std::string &path)
  {
    require_regular_file(path);
    std::ifstream in(path);
    if (!in)
      throw std::invalid_argument(path + ": cannot be opened; is it there and readable?");
    const auto words_of = [](const std::string &line) {
      std::vector<std::string> words;
      std::size_t              begin = 0;
      for (std::size_t end; (end = line.find(',', begin)) != std::string::npos; begin = end + 1)
        words.push_back(line.substr(begin, end - begin));
      words.push_back(line.substr(begin));
      return words;
    };
    WordTable   table;
    std::string line;
    table.path = path;
    std::getline(in, line);
    table.columns = words_of(line);
    while (std::getline(in, line) && !in.eof())
      {
        table.rows.push_back(words_of(line));
        if (table.rows.back().size() != table.columns.size())
          throw std::invalid_argument(path + ", line " + std::to_string(table.rows.size() + 1) + ": " +
                                      std::to_string(table.rows.back().size()) + " entries for " +
                                      std::to_string(table.columns.size()) + " columns");
      }
    return table;
  }
} // namespace diptych::discrete
