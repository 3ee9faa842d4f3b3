// diptych: tables of numbers in comma-separated files, checked as they are read
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "discrete/files/text_file.h"

namespace diptych::discrete
{
  // Numbers under named columns; rows[k][c] belongs to columns[c] and stood in line[k] of the file, counted from 1.
  struct CsvTable
  {
    std::string                      path;
    std::vector<std::string>         columns;
    std::vector<std::vector<double>> rows;
    std::vector<int>                 line;

    std::optional<std::size_t> find(const std::string &column) const;

    // Of a column that is there (a required one).
    double at(std::size_t row, const std::string &column) const { return rows[row][*find(column)]; }
  };

  // What the header line may name, in any order.
  struct CsvHeader
  {
    std::vector<std::string> required;
    std::vector<std::string> optional = {};
    bool                     others   = false; // true: further columns are read, too; false: they are an error
  };

  // The first line names the columns, every other one holds as many finite numbers, separated by commas. Blanks around fields,
  // blank lines and lines that start with # are skipped. Numbers are read as in C whatever the locale, rounded correctly: what
  // exact_text() wrote comes back with the same bits.
  // Throws std::invalid_argument naming file, line, column and value: file missing, empty or without a row; column missing,
  // unknown (with the nearest known one), unnamed or named twice; another number of fields; not a number, not finite, beyond
  // double precision. Calls `check_stop` between lines.
  CsvTable read_csv(const std::string &path, const CsvHeader &header, const CheckStop &check_stop = {});

  // "FILE, line N: column 'r' = '-1'"
  std::string cell_place(const CsvTable &table, std::size_t row, const std::string &column);

  // Throws std::invalid_argument "FILE, line N: column 'r' = '-1' is out of range; allowed: ...".
  [[noreturn]] void refuse_cell(const CsvTable &table, std::size_t row, const std::string &column, const std::string &allowed);

  // The shortest text that reads back as the same double (at most 17 significant digits), with a point in every locale.
  std::string exact_text(double value);
} // namespace diptych::discrete
