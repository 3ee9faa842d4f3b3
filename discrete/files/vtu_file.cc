// diptych: grids with fields as VTK files, which ParaView and meshio open
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/files/vtu_file.h"

#include <filesystem>
#include <sstream>
#include <stdexcept>

#include "discrete/files/csv_file.h"
#include "discrete/files/staged_file.h"
#include "discrete/files/text_file.h"

namespace diptych::discrete
{
  namespace
  {
    static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "the byte order that the files name");

    unsigned int nodes_per_cell(const VtkCell type)
    {
      switch (type)
        {
        case VtkCell::vertex:
          return 1;
        case VtkCell::line:
          return 2;
        case VtkCell::quadrilateral:
          return 4;
        default:
          return 9;
        }
    }

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
    const char *type_of(const float *) { return "Float32"; }
    const char *type_of(const std::int32_t *) { return "Int32"; }
    const char *type_of(const std::uint8_t *) { return "UInt8"; }
    // clang-format on

    // VTK's uncompressed binary array: the number of bytes as UInt64, then the bytes, base64 over both.
    template <class T>
    void add_array(std::ostream &out, const std::string &name, const unsigned int n_components, const std::vector<T> &values)
    {
      const std::uint64_t n_bytes = values.size() * sizeof(T);
      std::string         bytes(reinterpret_cast<const char *>(&n_bytes), sizeof n_bytes);
      bytes.append(reinterpret_cast<const char *>(values.data()), n_bytes);
      out << "<DataArray type=\"" << type_of(values.data()) << "\" Name=\"" << name << "\" NumberOfComponents=\"" << n_components
          << "\" format=\"binary\">\n"
          << base64(bytes) << "\n</DataArray>\n";
    }

    void add_cells(std::ostream &out, const VtuGrid &grid, const std::size_t n_cells)
    {
      std::vector<std::int32_t> connectivity(grid.cells.begin(), grid.cells.end()), offsets;
      for (std::size_t k = 1; k <= n_cells; ++k)
        offsets.push_back(std::int32_t(k * nodes_per_cell(grid.type)));
      out << "<Cells>\n";
      add_array(out, "connectivity", 1, connectivity);
      add_array(out, "offsets", 1, offsets);
      add_array(out, "types", 1, std::vector<std::uint8_t>(n_cells, std::uint8_t(grid.type)));
      out << "</Cells>\n";
    }

    void add_fields(std::ostream &out, const VtuGrid &grid, const bool of_nodes, const std::size_t n)
    {
      out << (of_nodes ? "<PointData>\n" : "<CellData>\n");
      for (const VtuField &field : grid.fields)
        if (field.of_nodes == of_nodes)
          {
            if (field.values.size() != n * field.n_components)
              throw std::invalid_argument("field " + field.name + ": " + std::to_string(field.values.size()) + " numbers for " +
                                          std::to_string(n) + (of_nodes ? " nodes" : " cells"));
            add_array(out, field.name, field.n_components, std::vector<float>(field.values.begin(), field.values.end()));
          }
      out << (of_nodes ? "</PointData>\n" : "</CellData>\n");
    }
  } // namespace

  void write_vtu(const std::string &path, const VtuGrid &grid)
  {
    const std::size_t  n_cells = grid.cells.size() / nodes_per_cell(grid.type);
    std::vector<float> points;
    for (const Eigen::Vector2d &x : grid.points)
      points.insert(points.end(), {float(x.x()), float(x.y()), 0.f});
    std::ostringstream out;
    out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
           "header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\""
        << grid.points.size() << "\" NumberOfCells=\"" << n_cells << "\">\n<Points>\n";
    add_array(out, "position", 3, points);
    out << "</Points>\n";
    add_cells(out, grid, n_cells);
    add_fields(out, grid, true, grid.points.size());
    add_fields(out, grid, false, n_cells);
    out << "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
    write_text(path, out.str());
  }

  VtuSeries::VtuSeries(std::string path_without_ending, std::vector<double> kept, const std::size_t first)
      : path(std::move(path_without_ending)),
        times(std::move(kept)),
        first(first)
  {
    for (std::size_t k = times.size(); std::filesystem::remove(path + file(k)); ++k)
      {}
  }

  std::string VtuSeries::file(const std::size_t k) const
  {
    return "/" + stage_name(first + k) + ".vtu";
  }

  void VtuSeries::add(const double time, const VtuGrid &grid)
  {
    std::filesystem::create_directories(path);
    write_vtu(path + file(times.size()), grid);
    times.push_back(time);
    const std::string folder = std::filesystem::path(path).filename();
    std::string list = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
                       "<Collection>\n";
    for (std::size_t k = 0; k < times.size(); ++k)
      list += "<DataSet timestep=\"" + exact_text(tidy(times[k])) + "\" part=\"0\" file=\"" + folder + file(k) + "\"/>\n";
    write_text(path + ".pvd", list + "</Collection>\n</VTKFile>\n");
  }
} // namespace diptych::discrete
