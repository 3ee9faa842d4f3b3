// diptych: places and forces of walls as a table beside another code's files
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/import/foreign_sample.h"
#include "coupling/import/number_table.h"

namespace diptych::coupling
{
  // Whether a file names columns of a wall table in its first lines: width and height, or left_x, right_x, lower_y, upper_y (some
  // of them), beside step, time or frame.
  bool is_wall_table(const std::string &path);

  // One row a frame: step, time or frame (the row of this value is taken), width and height (the lower left corner is the origin)
  // or left_x, right_x, lower_y, upper_y (each as far as there is such a wall), upper_travel, and forces left_fx, left_fy, ... of
  // either sign. Adds to the walls of the frames. Throws SceneError naming the file and a frame that has no row.
  void add_wall_table(ForeignSample &sample, const NumberTable &table);

  // The rows of several files with the same columns, as one table.
  void add_wall_tables(ForeignSample &sample, const std::vector<std::string> &paths);
} // namespace diptych::coupling
