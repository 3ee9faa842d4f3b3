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
  // Comma-separated values below a line of column names. Rows are appended, and no earlier byte changes. Numbers are written with
  // all digits needed to read the same bits back. Throws std::runtime_error with the name of a file that cannot be written.
  class TableFile
  {
  public:
    TableFile(std::string path, const std::string &header); // begins a new file

    // Appends to the first n_rows of an existing file. Throws like check_table().
    TableFile(std::string path, const std::string &header, long n_rows);

    void add(const std::string &line); // without line end; written at flush(), or once a megabyte is waiting
    void flush();

    long n_rows() const { return n; }

  private:
    std::string path, waiting;
    long        n = 0;
  };

  // Throws std::invalid_argument with the file's name if it is missing, has other columns or fewer rows.
  void check_table(const std::string &path, const std::string &header, long n_rows);

  // Header and lines for rows whose type has a function visit_columns(row, visit), which calls visit(name, value, unit, meaning).
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

  struct WordTable
  {
    std::string                           path;
    std::vector<std::string>              columns;
    std::vector<std::vector<std::string>> rows;

    std::size_t       place_of(const std::string &column) const;
    [[noreturn]] void refuse(std::size_t row, const std::string &column, const std::string &value) const;
  };

  // Throws std::invalid_argument with the file's name if it is missing, or if a line has a wrong number of fields. A last line
  // without a line end is left out, because its writer was interrupted.
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

  // Reads rows with the same bits as they were written (any NaN counts as NaN). Columns are found by name; other columns are
  // ignored. Row needs a function visit_columns. Throws std::invalid_argument with file, line, column and value.
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

  template <class Row> std::vector<Row> read_history(const std::string &path)
  {
    std::vector<Row> rows = read_rows<Row>(path);
    if (rows.empty())
      throw std::invalid_argument(path + ": holds no row");
    return rows;
  }
} // namespace diptych::discrete
