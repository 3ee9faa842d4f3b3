// diptych: cells with fields as a VTK unstructured grid, which ParaView opens
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace diptych::coupling
{
  enum class VtkCell : std::uint8_t
  {
    quadrilateral             = 9, // four nodes, anticlockwise
    biquadratic_quadrilateral = 28 // then the middles of the edges and the centre
  };

  // One array: (n), (n, 3) or (n, 9), row by row.
  struct VtuField
  {
    std::string         name;
    unsigned int        n_components = 1;
    std::vector<double> values;
    bool                of_nodes = false;
  };

  struct VtuGrid
  {
    std::vector<Eigen::Vector2d> points;
    std::vector<unsigned int>    cells; // nodes of all cells, one after the other
    VtkCell                      type = VtkCell::quadrilateral;
    std::vector<VtuField>        fields;
  };

  // Uncompressed binary arrays, all numbers with all bits, NaN where there is none. Throws std::runtime_error naming the file,
  // std::invalid_argument for a field of another length than its nodes or cells are many.
  void write_vtu(const std::string &path, const VtuGrid &grid);

  // PATH.pvd: the .vtu files, relative to it, in the order of `time`.
  struct PvdEntry
  {
    double      time = 0;
    std::string file;
  };
  void write_pvd(const std::string &path, const std::vector<PvdEntry> &entries);
} // namespace diptych::coupling
