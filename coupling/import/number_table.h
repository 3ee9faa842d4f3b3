// diptych: tables of numbers with named columns, as other codes write them
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "coupling/import/foreign_sample.h"
#include "coupling/import/text_lines.h"

namespace diptych::coupling
{
  struct NumberTable
  {
    std::string              path;
    std::vector<std::string> columns;
    std::vector<double>      values; // row by row
    std::vector<int>         line;   // of each row

    std::size_t n_rows() const { return line.size(); }
    double      at(std::size_t row, std::size_t column) const { return values[row * columns.size() + column]; }
    bool        has(const std::string &column) const { return find(column).has_value(); }

    std::optional<std::size_t> find(const std::string &column) const; // ignores case
    // The first of these names that exists.
    std::optional<std::size_t> find_any(const std::vector<std::string> &names) const;
    // Throws SceneError naming the file and its columns.
    std::size_t place_of(const std::string &column) const;
    std::size_t place_of_any(const std::vector<std::string> &names, const std::string &what) const;

    [[noreturn]] void refuse(std::size_t row, const std::string &why) const;
    long              whole(std::size_t row, std::size_t column) const;
    double            positive(std::size_t row, std::size_t column) const;
  };

  // Adds one line of numbers. Throws SceneError if their number differs from that of the columns.
  void add_row(NumberTable &table, const TextLines &lines, std::string_view text);

  // Reads column names from the first line of words (after '#', if there is one) and numbers below it. Skips further comments
  // and blank lines. A table without names uses `columns`. Throws SceneError if it has neither.
  NumberTable read_number_table(const std::string &path, const std::vector<std::string> &columns = {});

  // Reads grains from columns with known names: id, x, y, r or radius, mass, vx, vy, omega, rotation, fx, fy, ... Throws
  // SceneError naming the file and the missing or impossible entry.
  std::vector<ForeignGrain> grains_of(const NumberTable &table);

  // The names after "kind=" in an option such as "contacts=a,b,c"; empty if there is none.
  std::vector<std::string> columns_for(const ForeignOptions &options, const std::string &kind);
} // namespace diptych::coupling
