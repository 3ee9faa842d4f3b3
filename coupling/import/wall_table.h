// diptych: places and forces of walls from a table beside another code's files
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/import/foreign_sample.h"
#include "coupling/import/number_table.h"

namespace diptych::coupling
{
  // True if the first lines name columns of a wall table: width and height, or some of left_x, right_x, lower_y, upper_y, with
  // step, time or frame.
  bool is_wall_table(const std::string &path);

  // One row per frame, found by step, time or frame. Places are width and height (the lower left corner is the origin), or
  // those of left_x, right_x, lower_y, upper_y that exist. Optional: upper_travel and forces left_fx, left_fy, ... of either
  // sign. Adds all to the walls of the frames. Throws SceneError naming the file and a frame without a row.
  void add_wall_table(ForeignSample &sample, const NumberTable &table);

  // Rows of several files with the same columns form one table.
  void add_wall_tables(ForeignSample &sample, const std::vector<std::string> &paths);
} // namespace diptych::coupling
