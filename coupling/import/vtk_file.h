// diptych: reads arrays from VTK's XML files
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

namespace diptych::coupling
{
  struct VtkArray
  {
    std::string         name;
    std::size_t         components = 1;
    std::vector<double> values; // row by row

    std::size_t n_rows() const { return values.size() / components; }
  };

  // Arrays below an element of the single Piece of a .vtu or .vtp: "PointData", "CellData", "Points", "Lines". Supports ASCII,
  // binary and appended base64, with or without zlib, little endian. Throws SceneError naming file and array if something is
  // missing, truncated, damaged or not finite.
  class VtkFile
  {
  public:
    explicit VtkFile(const std::string &path);

    bool     has(const std::string &element, const std::string &name) const;
    VtkArray read(const std::string &element, const std::string &name, std::size_t components) const;

  private:
    struct Entry
    {
      std::string element, name, type, format, text;
      std::size_t components, offset;
    };

    std::string        path, appended;
    bool               compressed = false, wide_header = false;
    std::vector<Entry> entries;
  };
} // namespace diptych::coupling
