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
    biquadratic_quadrilateral = 28 // the four nodes, then the middles of the edges and the centre
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

  // Writes uncompressed binary arrays with all bits; missing values are NaN. Throws std::runtime_error with the file's name, and
  // std::invalid_argument if the length of a field is not the number of nodes or cells.
  void write_vtu(const std::string &path, const VtuGrid &grid);

  // Writes PATH.pvd, the list of .vtu files with paths relative to it, in the order of `time`.
  struct PvdEntry
  {
    double      time = 0;
    std::string file;
  };
  void write_pvd(const std::string &path, const std::vector<PvdEntry> &entries);
} // namespace diptych::coupling
