// diptych: one stage of the continuum panel as a VTK unstructured grid
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cstdint>

#include "continuum/hdf5_fields.h"
#include "continuum/output.h"
#include "continuum/text_file.h"

namespace diptych::continuum
{
  namespace
  {
    constexpr std::uint8_t biquadratic_quad = 28; // VTK's cell type, nine nodes

    static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "the byte order that the files name");

    std::string base64(const std::string &bytes)
    {
      constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
      const auto     byte     = [&](const std::size_t k) { return k < bytes.size() ? std::uint8_t(bytes[k]) : 0u; };
      std::string    text;
      text.reserve((bytes.size() + 2) / 3 * 4);
      for (std::size_t k = 0; k < bytes.size(); k += 3)
        {
          const std::uint32_t three = byte(k) << 16 | byte(k + 1) << 8 | byte(k + 2);
          text.push_back(digits[three >> 18]);
          text.push_back(digits[three >> 12 & 63]);
          text.push_back(k + 1 < bytes.size() ? digits[three >> 6 & 63] : '=');
          text.push_back(k + 2 < bytes.size() ? digits[three & 63] : '=');
        }
      return text;
    }

    // clang-format off
    const char *type_of(const double *) { return "Float64"; }
    const char *type_of(const std::int32_t *) { return "Int32"; }
    const char *type_of(const std::uint8_t *) { return "UInt8"; }
    // clang-format on

    // VTK's uncompressed binary array: the number of bytes as UInt64, then the bytes, base64 over both.
    template <class T>
    void write_array(std::ostream &out, const char *name, const unsigned int n_components, const std::vector<T> &values)
    {
      const std::uint64_t n_bytes = values.size() * sizeof(T);
      std::string         bytes(reinterpret_cast<const char *>(&n_bytes), sizeof n_bytes);
      bytes.append(reinterpret_cast<const char *>(values.data()), n_bytes);
      out << "<DataArray type=\"" << type_of(values.data()) << "\" Name=\"" << name << "\" NumberOfComponents=\"" << n_components
          << "\" format=\"binary\">\n"
          << base64(bytes) << "\n</DataArray>\n";
    }

    void write_cells(std::ostream &out, const std::vector<std::array<unsigned int, 9>> &cells)
    {
      std::vector<std::int32_t> connectivity, offsets;
      for (const auto &cell : cells)
        {
          connectivity.insert(connectivity.end(), cell.begin(), cell.end());
          offsets.push_back(connectivity.size());
        }
      out << "<Cells>\n";
      write_array(out, "connectivity", 1, connectivity);
      write_array(out, "offsets", 1, offsets);
      write_array(out, "types", 1, std::vector<std::uint8_t>(cells.size(), biquadratic_quad));
      out << "</Cells>\n";
    }

    void write_fields(std::ostream &out, const Snapshot &s, const bool nodes)
    {
      for (const Field &field : fields)
        if (of_nodes(field) == nodes && is_carried(field, !s.rotation.empty()))
          write_array(out, field.name, n_components(field), values_of(s, field));
    }
  } // namespace

  void write_vtu(const std::string &vtu_file, const Snapshot &s)
  {
    require_equal_lengths(s);
    write_text_file(vtu_file, [&](std::ostream &out) {
      out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
             "header_type=\"UInt64\">\n<UnstructuredGrid>\n"
          << "<Piece NumberOfPoints=\"" << s.position.size() << "\" NumberOfCells=\"" << s.cells.size() << "\">\n<Points>\n";
      write_array(out, position_field.name, n_components(position_field), values_of(s, position_field));
      out << "</Points>\n";
      write_cells(out, s.cells);
      out << "<PointData Vectors=\"displacement\">\n";
      write_fields(out, s, true);
      out << "</PointData>\n<CellData Tensors=\"stress\">\n";
      write_fields(out, s, false);
      out << "</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
    });
  }
} // namespace diptych::continuum
