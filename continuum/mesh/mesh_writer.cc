// diptych: writes meshes to the files that deal.II, gmsh and ParaView read
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <stdexcept>

#include "continuum/mesh/mesh.h"

namespace diptych::continuum
{
  namespace
  {
    constexpr int msh_line = 1, msh_quadrilateral = 3; // element types of the format

    void write_physical_names(std::ostream &out, const QuadMesh &mesh)
    {
      std::set<BoundaryId> present;
      for (const auto &edge : mesh.boundary)
        present.insert(edge.id);
      out << "$PhysicalNames\n" << present.size() + 1 << "\n";
      for (const BoundaryId id : present)
        out << "1 " << id << " \"" << name_of(id) << "\"\n";
      out << "2 1 \"sample\"\n$EndPhysicalNames\n";
    }

    // An element is: number, type, number of tags (2), physical group, entity, vertices counted from 1.
    void write_elements(std::ostream &out, const QuadMesh &mesh)
    {
      std::size_t number = 0;
      out << "$Elements\n" << mesh.boundary.size() + mesh.cells.size() << "\n";
      for (const auto &[vertices, id] : mesh.boundary)
        out << ++number << " " << msh_line << " 2 " << id << " " << id << " " << vertices[0] + 1 << " " << vertices[1] + 1
            << "\n";
      for (const auto &cell : mesh.cells)
        {
          out << ++number << " " << msh_quadrilateral << " 2 1 1";
          for (const unsigned int vertex : cell)
            out << " " << vertex + 1;
          out << "\n";
        }
      out << "$EndElements\n";
    }
  } // namespace

  void write_mesh(const QuadMesh &mesh, const std::string &file)
  {
    const std::string temporary = file + ".part";
    std::ofstream     out(temporary);
    out.precision(std::numeric_limits<double>::max_digits10);
    out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
    write_physical_names(out, mesh);
    out << "$Nodes\n" << mesh.vertices.size() << "\n";
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
      out << i + 1 << " " << mesh.vertices[i].x() << " " << mesh.vertices[i].y() << " 0\n";
    out << "$EndNodes\n";
    write_elements(out, mesh);
    out.close();
    std::error_code error;
    if (out)
      std::filesystem::rename(temporary, file, error);
    if (!out || error)
      {
        std::error_code ignored; // the error to report is the failed writing
        std::filesystem::remove(temporary, ignored);
        throw std::runtime_error("cannot write the mesh file " + file);
      }
  }
} // namespace diptych::continuum
