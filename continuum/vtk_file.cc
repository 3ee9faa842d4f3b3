// diptych: one stage of the continuum panel as a VTK unstructured grid
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/output.h"
#include "continuum/text_file.h"

namespace diptych::continuum
{
  namespace
  {
    constexpr int biquadratic_quad = 28; // VTK's cell type, nine nodes

    // One <DataArray> whose values are given by value(stream, i) for i < n.
    template <class Value>
    void write_array(std::ostream     &out,
                     const char       *type,
                     const char       *name,
                     const int         n_components,
                     const std::size_t n,
                     Value           &&value)
    {
      out << "<DataArray type=\"" << type << "\" Name=\"" << name << "\" NumberOfComponents=\"" << n_components
          << "\" format=\"ascii\">\n";
      for (std::size_t i = 0; i < n; ++i)
        {
          value(i);
          out << '\n';
        }
      out << "</DataArray>\n";
    }

    void write_vectors(std::ostream &out, const char *name, const std::vector<Eigen::Vector2d> &v)
    {
      write_array(out, "Float64", name, 3, v.size(), [&](const std::size_t i) { out << v[i].x() << ' ' << v[i].y() << " 0"; });
    }

    void write_tensors(std::ostream                 &out,
                       const char                   *name,
                       const std::vector<CellState> &states,
                       Eigen::Matrix3d CellState::*member)
    {
      write_array(out, "Float64", name, 9, states.size(), [&](const std::size_t i) {
        for (int row = 0; row < 3; ++row)
          for (int column = 0; column < 3; ++column)
            out << (states[i].*member)(row, column) << ' ';
      });
    }

    void write_scalars(std::ostream &out, const char *name, const std::vector<CellState> &states, double CellState::*member)
    {
      write_array(out, "Float64", name, 1, states.size(), [&](const std::size_t i) { out << states[i].*member; });
    }

    void write_cells(std::ostream &out, const Snapshot &s)
    {
      out << "<Cells>\n";
      write_array(out, "Int32", "connectivity", 1, s.cells.size(), [&](const std::size_t i) {
        for (const auto node : s.cells[i])
          out << node << ' ';
      });
      write_array(out, "Int32", "offsets", 1, s.cells.size(), [&](const std::size_t i) { out << 9 * (i + 1); });
      write_array(out, "UInt8", "types", 1, s.cells.size(), [&](const std::size_t) { out << biquadratic_quad; });
      out << "</Cells>\n";
    }
  } // namespace

  void write_vtu(const std::string &vtu_file, const Snapshot &s)
  {
    write_text_file(vtu_file, [&](std::ostream &out) {
      out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
             "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n"
          << "<Piece NumberOfPoints=\"" << s.position.size() << "\" NumberOfCells=\"" << s.cells.size() << "\">\n<Points>\n";
      write_vectors(out, "position", s.position);
      out << "</Points>\n";
      write_cells(out, s);
      out << "<PointData Vectors=\"displacement\">\n";
      write_vectors(out, "displacement", s.displacement);
      out << "</PointData>\n<CellData Tensors=\"stress\">\n";
      write_tensors(out, "stress", s.cell_state, &CellState::stress);
      write_tensors(out, "strain", s.cell_state, &CellState::strain);
      write_scalars(out, "equivalent_plastic_strain", s.cell_state, &CellState::equivalent_plastic_strain);
      write_scalars(out, "area", s.cell_state, &CellState::area);
      out << "</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
    });
  }
} // namespace diptych::continuum
