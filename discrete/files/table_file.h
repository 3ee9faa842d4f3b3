// diptych: a table of numbers that grows row by row
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <charconv>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "discrete/choices.h"
#include "discrete/files/csv_file.h"

namespace diptych::discrete
{
  // Comma-separated values below a line of column names. Rows are appended, no earlier byte is touched; numbers are written with
  // the digits that give the same bits back. Throws std::runtime_error naming the file where it cannot be written.
  class TableFile
  {
  public:
    TableFile(std::string path, const std::string &header); // begins anew

    // Goes on after the first n_rows of a file that stands there. Throws as check_table().
    TableFile(std::string path, const std::string &header, long n_rows);

    void add(const std::string &line); // without its end; kept until flush(), or until a megabyte waits
    void flush();

    long n_rows() const { return n; }

  private:
    std::string path, waiting;
    long        n = 0;
  };

  // Throws std::invalid_argument naming the file where it is missing, has other columns or fewer rows.
  void check_table(const std::string &path, const std::string &header, long n_rows);

  // The header and the line of a row whose type has a visit_columns beside it: visit(name, value, unit, meaning).
  template <class Row> std::string csv_header()
  {
    std::string text;
    Row         row;
    visit_columns(
      row, [&](const char *name, auto &, const char *, const char *) { text += (text.empty() ? "" : ",") + std::string(name); });
    return text;
  }

  template <class Row> std::string csv_line(const Row &row)
  {
    std::string text;
    visit_columns(row, [&](const char *, const auto &value, const char *, const char *) {
      if (!text.empty())
        text += ',';
      if constexpr (std::is_enum_v<std::decay_t<decltype(value)>>)
        text += discrete::name_of(value);
      else if constexpr (std::is_integral_v<std::decay_t<decltype(value)>>)
        text += std::to_string(value);
      else
        text += exact_text(value);
    });
    return text;
  }

  // The words of a table, line by line.
  struct WordTable
  {
    std::string                           path;
    std::vector<std::string>              columns;
    std::vector<std::vector<std::string>> rows;

    // Throws std::invalid_argument naming the file and the column where it is not there.
    std::size_t       place_of(const std::string &column) const;
    [[noreturn]] void refuse(std::size_t row, const std::string &column, const std::string &value) const;
  };

  // Throws std::invalid_argument naming the file where it is missing or a line has another number of entries. A last line that
  // has no end is left out: it was being written.
  WordTable read_words(const std::string &path);

  template <class Value> bool parse_word(const std::string &word, Value &value)
  {
    if constexpr (std::is_enum_v<Value>)
      {
        for (const auto &[choice, name] : choices(Value()))
          if (word == name)
            {
              value = choice;
              return true;
            }
        return false;
      }
    else
      {
        const auto end = std::from_chars(word.data(), word.data() + word.size(), value);
        return end.ec == std::errc() && end.ptr == word.data() + word.size();
      }
  }

  // The rows of a table whose Row has a visit_columns, bit by bit as they were written (but NaN is any NaN); columns are found by
  // name, others are not looked at. Throws std::invalid_argument naming file, line, column and value.
  template <class Row> std::vector<Row> read_rows(const std::string &path)
  {
    const WordTable          table = read_words(path);
    std::vector<Row>         rows(table.rows.size());
    Row                      prototype;
    std::vector<std::size_t> places;
    visit_columns(prototype,
                  [&](const char *name, auto &, const char *, const char *) { places.push_back(table.place_of(name)); });
    for (std::size_t k = 0; k < rows.size(); ++k)
      {
        auto place = places.begin();
        visit_columns(rows[k], [&](const char *name, auto &value, const char *, const char *) {
          const std::string &word = table.rows[k][*place++];
          if (!parse_word(word, value))
            table.refuse(k, name, word);
        });
      }
    return rows;
  }

  // The same of what ran: at least one row. Throws where there is none, too.
  template <class Row> std::vector<Row> read_history(const std::string &path)
  {
    std::vector<Row> rows = read_rows<Row>(path);
    if (rows.empty())
      throw std::invalid_argument(path + ": holds no row");
    return rows;
  }
} // namespace diptych::discrete
