// diptych: places and forces of walls as a table beside another code's files
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

    // The row of a frame: that of its step, its time or its number.
    std::size_t row_of(const NumberTable &table, const ForeignFrame &frame, const std::size_t number)
    {
      const auto step = table.find("step"), time = table.find("time"), count = table.find("frame");
      const auto first = [&](const auto &is_of) -> std::optional<std::size_t> {
        std::optional<std::size_t> one;
        for (std::size_t row = 0; row < table.n_rows(); ++row)
          if (is_of(row) && !one)
            one = row;
          else if (is_of(row))
            for (std::size_t column = 0; column < table.columns.size(); ++column)
              if (table.at(row, column) != table.at(*one, column))
                table.refuse(row, "frame " + frame.name + " stands in line " + std::to_string(table.line[*one]) +
                                    " with another " + table.columns[column]);
        return one;
      };
      std::optional<std::size_t> found;
      if (step && frame.step)
        found = first([&](const std::size_t row) { return table.whole(row, *step) == *frame.step; });
      else if (time && frame.time)
        found = first(
          [&](const std::size_t row) { return std::abs(table.at(row, *time) - *frame.time) <= 1e-9 * std::abs(*frame.time); });
      if (!found && count && frame.step) // the number in the name of a table
        found = first([&](const std::size_t row) { return table.whole(row, *count) == *frame.step; });
      if (!found && count)
        found = first([&](const std::size_t row) { return table.whole(row, *count) == long(number); });
      if (found)
        return *found;
      if (!(step && frame.step) && !(time && frame.time) && !count && number < table.n_rows())
        return number;
      throw SceneError(table.path + ": has no row for frame " + frame.name + " (column step, time or frame)");
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
    NumberTable all;
    for (const std::string &path : paths)
      {
        const NumberTable table = read_number_table(path);
        if (all.columns.empty())
          all = table;
        else if (all.columns != table.columns)
          throw SceneError(path + ": other columns than " + all.path);
        else
          {
            all.values.insert(all.values.end(), table.values.begin(), table.values.end());
            all.line.insert(all.line.end(), table.line.begin(), table.line.end());
          }
      }
    if (!paths.empty())
      add_wall_table(sample, all);
  }

  void add_wall_table(ForeignSample &sample, const NumberTable &table)
  {
    for (std::size_t k = 0; k < sample.frames.size(); ++k)
      {
        ForeignFrame     &frame = sample.frames[k];
        const std::size_t row   = row_of(table, frame, k);
        add_places(table, row, frame);
        add_forces(table, row, frame);
        if (const auto time = table.find("time"); time && !frame.time)
          frame.time = table.at(row, *time);
      }
  }
} // namespace diptych::coupling
