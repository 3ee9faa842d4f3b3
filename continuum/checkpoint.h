// diptych: the continuum panel put down in a file, to be taken up again
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

namespace diptych::continuum
{
  // Plain values; what they mean, with units and signs, is the writer's affair.
  struct Checkpoint
  {
    std::string fingerprint; // of mesh, loading and options: a run with another one must refuse the checkpoint

    std::vector<std::string> cells; // deal.II's CellId as text of every active cell, sorted; no line breaks
    unsigned int             values_per_cell = 0;
    std::vector<double>      values; // cells.size() x values_per_cell, row by row: nodal values and point states of one cell

    std::map<std::string, double>    scalars; // names without line breaks
    std::map<std::string, long long> counts;
  };

  // HDF5 with checksums, all numbers with all bits (NaN, too); replaces the file only when complete. To be called by one process
  // only. Throws std::runtime_error naming the file, std::invalid_argument for contents that contradict each other.
  void write_checkpoint(const std::string &file, const Checkpoint &checkpoint);

  // Throws std::runtime_error naming the file when it is missing, cut short, damaged or no checkpoint of this panel.
  Checkpoint read_checkpoint(const std::string &file);
} // namespace diptych::continuum
