// diptych: places and forces of walls from a table beside another code's files
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/import/wall_table.h"

#include <cmath>

#include "coupling/scene/scene_error.h"

namespace diptych::coupling
{
  namespace
  {
    constexpr const char *places[] = {"lower_y", "upper_y", "left_x", "right_x"};

    ForeignWall &wall_of(ForeignFrame &frame, const Side side)
    {
      for (ForeignWall &wall : frame.walls)
        if (wall.side == side)
          return wall;
      frame.walls.push_back({side_names[int(side)], side});
      return frame.walls.back();
    }

    struct WallRow
    {
      const NumberTable *table;
      std::size_t        row;
    };

    void require_equal(const WallRow &one, const WallRow &other, const ForeignFrame &frame)
    {
      for (std::size_t column = 0; column < one.table->columns.size(); ++column)
        if (other.table->at(other.row, column) != one.table->at(one.row, column))
          other.table->refuse(other.row, "frame " + frame.name + " has another " + one.table->columns[column] + " in line " +
                                           std::to_string(one.table->line[one.row]) +
                                           (one.table == other.table ? "" : " of " + one.table->path));
    }

    std::vector<WallRow> rows_of(const std::vector<NumberTable> &tables)
    {
      std::vector<WallRow> rows;
      for (const NumberTable &table : tables)
        for (std::size_t row = 0; row < table.n_rows(); ++row)
          rows.push_back({&table, row});
      return rows;
    }

    // The row of a frame, found by its step, time or number. `columns`: a table with the columns of all.
    WallRow row_of(const std::vector<WallRow> &rows,
                   const NumberTable          &columns,
                   const ForeignFrame         &frame,
                   const std::size_t           number)
    {
      const auto step = columns.find("step"), time = columns.find("time"), count = columns.find("frame");
      const auto first = [&](const auto &is_of) -> std::optional<WallRow> {
        std::optional<WallRow> one;
        for (const WallRow &row : rows)
          if (is_of(*row.table, row.row) && !one)
            one = row;
          else if (is_of(*row.table, row.row))
            require_equal(*one, row, frame);
        return one;
      };
      const auto first_whole = [&](const std::size_t column, const long value) {
        return first([&](const NumberTable &table, const std::size_t row) { return table.whole(row, column) == value; });
      };
      std::optional<WallRow> found;
      if (step && frame.step)
        found = first_whole(*step, *frame.step);
      else if (time && frame.time)
        found = first([&](const NumberTable &table, const std::size_t row) {
          return std::abs(table.at(row, *time) - *frame.time) <= 1e-9 * std::abs(*frame.time);
        });
      if (!found && count && frame.step) // the number in the name of a table
        found = first_whole(*count, *frame.step);
      if (!found && count)
        found = first_whole(*count, long(number));
      if (found)
        return *found;
      if (!(step && frame.step) && !(time && frame.time) && !count && number < rows.size())
        return rows[number];
      throw SceneError(columns.path + ": has no row for frame " + frame.name + " (column step, time or frame)");
    }

    void add_places(const NumberTable &table, const std::size_t row, ForeignFrame &frame)
    {
      if (table.has("width") && table.has("height"))
        {
          wall_of(frame, Side::lower).place = wall_of(frame, Side::left).place = 0;
          wall_of(frame, Side::right).place                                    = table.positive(row, table.place_of("width"));
          wall_of(frame, Side::upper).place                                    = table.positive(row, table.place_of("height"));
        }
      for (const int side : {0, 1, 2, 3})
        if (const auto column = table.find(places[side]))
          wall_of(frame, Side(side)).place = table.at(row, *column);
      if (const auto column = table.find("upper_travel"))
        wall_of(frame, Side::upper).travel = table.at(row, *column);
    }

    void add_forces(const NumberTable &table, const std::size_t row, ForeignFrame &frame)
    {
      for (const int side : {0, 1, 2, 3})
        {
          const std::string name = side_names[side];
          const auto        fx = table.find(name + "_fx"), fy = table.find(name + "_fy");
          if (fx && fy)
            wall_of(frame, Side(side)).force = {table.at(row, *fx), table.at(row, *fy)};
        }
    }

    void add_wall_rows(ForeignSample &sample, const std::vector<NumberTable> &tables)
    {
      const std::vector<WallRow> rows = rows_of(tables);
      for (std::size_t k = 0; k < sample.frames.size(); ++k)
        {
          ForeignFrame &frame     = sample.frames[k];
          const auto [table, row] = row_of(rows, tables.front(), frame, k);
          add_places(*table, row, frame);
          add_forces(*table, row, frame);
          frame.wall_file = table->path + ", line " + std::to_string(table->line[row]);
          if (const auto time = table->find("time"); time && !frame.time)
            frame.time = table->at(row, *time);
        }
    }
  } // namespace

  bool is_wall_table(const std::string &path)
  {
    TextLines lines(path);
    for (int k = 0; k < 3 && !lines.at_end(); ++k)
      {
        bool width = false, height = false, index = false;
        for (const std::string_view word : words_of(lines.take("a line")))
          {
            width |= word == "width" || word == "left_x" || word == "right_x";
            height |= word == "height" || word == "lower_y" || word == "upper_y";
            index |= word == "step" || word == "time" || word == "frame";
          }
        if (height && (width || index))
          return true;
      }
    return false;
  }

  void add_wall_tables(ForeignSample &sample, const std::vector<std::string> &paths)
  {
    std::vector<NumberTable> tables;
    for (const std::string &path : paths)
      {
        tables.push_back(read_number_table(path));
        if (tables.back().columns != tables.front().columns)
          throw SceneError(path + ": its columns differ from those of " + tables.front().path);
      }
    if (!tables.empty())
      add_wall_rows(sample, tables);
  }

  void add_wall_table(ForeignSample &sample, const NumberTable &table)
  {
    add_wall_rows(sample, {table});
  }
} // namespace diptych::coupling
