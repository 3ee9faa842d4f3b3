// diptych: tables of numbers under named columns, as other codes write them
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

    std::optional<std::size_t> find(const std::string &column) const; // capitals or not
    // Of the first of these names that is there.
    std::optional<std::size_t> find_any(const std::vector<std::string> &names) const;
    // Throws SceneError naming the file and what it has.
    std::size_t place_of(const std::string &column) const;
    std::size_t place_of_any(const std::vector<std::string> &names, const std::string &what) const;

    [[noreturn]] void refuse(std::size_t row, const std::string &why) const;
    long              whole(std::size_t row, std::size_t column) const;
    double            positive(std::size_t row, std::size_t column) const;
  };

  // One line of numbers. Throws SceneError where there are not as many as columns.
  void add_row(NumberTable &table, const TextLines &lines, std::string_view text);

  // Names in the first line of words (after a '#' where there is one), numbers below; further comments and blank lines are
  // skipped. A table without names takes `columns`. Throws SceneError where it has neither.
  NumberTable read_number_table(const std::string &path, const std::vector<std::string> &columns = {});

  // Grains and contacts of a table with columns of known names: id, x, y, r or radius, mass, vx, vy, omega, rotation, fx, fy, ...
  // Throws SceneError naming the file and what is missing or impossible.
  std::vector<ForeignGrain> grains_of(const NumberTable &table);

  // "contacts=a,b,c": the names after `kind`=; empty where the command line has none.
  std::vector<std::string> columns_for(const ForeignOptions &options, const std::string &kind);
} // namespace diptych::coupling
