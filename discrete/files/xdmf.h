// diptych: XDMF files beside HDF5 ones, which ParaView opens
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

namespace diptych::discrete
{
  enum class XdmfNumber
  {
    real,     // 8 bytes
    integer,  // 4 bytes
    unsigned_ // 4 bytes
  };

  struct XdmfArray
  {
    std::string              path; // within the file, like "stage_0001/grains/radius"
    std::vector<std::size_t> extents;
    XdmfNumber               number = XdmfNumber::real;
  };

  struct XdmfAttribute
  {
    std::string name;
    XdmfArray   array; // (n): scalar, (n, 3): vector, (n, 3, 3): tensor
    bool        of_cells = false;
  };

  // One instant of one grid: single points, or quadrilaterals with nine nodes.
  struct XdmfGrid
  {
    std::string                name;
    double                     time = 0;
    XdmfArray                  points; // (n, 3)
    XdmfArray                  cells;  // (n, 9); no extents: points
    std::vector<XdmfAttribute> attributes;
  };

  struct XdmfCollection
  {
    std::string           name;
    std::vector<XdmfGrid> grids;
  };

  // Writes PATH.xdmf beside PATH.h5. Throws std::runtime_error with the file's name.
  void write_xdmf(const std::string &path_without_ending, const std::vector<XdmfCollection> &collections);
} // namespace diptych::discrete
