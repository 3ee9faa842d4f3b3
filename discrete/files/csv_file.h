// diptych: tables of numbers in comma-separated files, checked as they are read
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "discrete/files/text_file.h"

namespace diptych::discrete
{
  // Numbers in named columns. rows[k][c] belongs to columns[c] and comes from line line[k] of the file, counted from 1.
  struct CsvTable
  {
    std::string                      path;
    std::vector<std::string>         columns;
    std::vector<std::vector<double>> rows;
    std::vector<int>                 line;

    std::optional<std::size_t> find(const std::string &column) const;

    double at(std::size_t row, const std::string &column) const { return rows[row][*find(column)]; }
  };

  // Column names that the header line may contain, in any order.
  struct CsvHeader
  {
    std::vector<std::string> required;
    std::vector<std::string> optional = {};
    bool                     others   = false; // true: other columns are also read; false: they are an error
  };

  // The first line names the columns. Every other line has as many finite numbers, separated by commas. Blanks around fields,
  // blank lines and lines that start with # are skipped. Numbers use a decimal point in every locale. Numbers that exact_text()
  // wrote come back with the same bits.
  // Throws std::invalid_argument with file, line, column and value if
  //   the file is missing, empty or has no row;
  //   a column is missing, unknown (the message proposes the nearest name), unnamed or named twice;
  //   a line has a wrong number of fields;
  //   a field is not a number, not finite or beyond double precision.
  // Calls `check_stop` between lines.
  CsvTable read_csv(const std::string &path, const CsvHeader &header, const CheckStop &check_stop = {});

  // "FILE, line N: column 'r' = '-1'"
  std::string cell_place(const CsvTable &table, std::size_t row, const std::string &column);

  [[noreturn]] void refuse_cell(const CsvTable &table, std::size_t row, const std::string &column, const std::string &allowed);

  // The shortest text that reads back as the same double (at most 17 significant digits), with a point in every locale.
  std::string exact_text(double value);

  // Ten digits of a number, without the round-off of sums and products: 0.3 for 3 x 0.1.
  double tidy(double value);
} // namespace diptych::discrete
