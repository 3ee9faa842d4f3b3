// diptych: a loading put down in a file, to be taken up again
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "discrete/panel.h"

namespace diptych::discrete
{
  // What a loading goes on from, with the history written so far. `scene` is a text that must be the same then.
  struct Checkpoint
  {
    Progress                progress; // drives of walls and cell are not kept: they follow from the scene
    std::vector<HistoryRow> rows;
    std::string             scene;
  };

  // HDF5, all numbers with all bits; replaces the file only when complete. Throws std::runtime_error naming it.
  void write_checkpoint(const std::string &path, const Checkpoint &checkpoint);

  // Throws std::runtime_error naming the file and what it lacks.
  Checkpoint read_checkpoint(const std::string &path);
} // namespace diptych::discrete
