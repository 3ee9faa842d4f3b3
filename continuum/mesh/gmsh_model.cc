// diptych: meshes from gmsh's open model
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/mesh/gmsh_model.h"

#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>

#include <gmsh.h>

namespace diptych::continuum
{
  namespace
  {
    constexpr int gmsh_line = 1, gmsh_quadrilateral = 3, gmsh_point = 15; // element types of gmsh

    void check_element_types()
    {
      std::vector<int> types;
      gmsh::model::mesh::getElementTypes(types);
      bool any_quadrilateral = false;
      for (const int type : types)
        {
          any_quadrilateral = any_quadrilateral || type == gmsh_quadrilateral;
          if (type == gmsh_line || type == gmsh_quadrilateral || type == gmsh_point)
            continue;
          std::string         name;
          int                 dimension, order, n_vertices, n_primary;
          std::vector<double> coordinates;
          gmsh::model::mesh::getElementProperties(type, name, dimension, order, n_vertices, coordinates, n_primary);
          throw std::invalid_argument("the mesh holds elements of the kind \"" + name +
                                      "\"; the panel needs four-node quadrilaterals and two-node lines only");
        }
      if (!any_quadrilateral)
        throw std::invalid_argument("the mesh holds no quadrilateral");
    }

    std::vector<std::size_t> element_vertices(const int type, const int entity = -1)
    {
      std::vector<std::size_t> tags, vertices;
      gmsh::model::mesh::getElementsByType(type, tags, vertices, entity);
      return vertices;
    }

    std::optional<BoundaryId> boundary_id(const int number, const std::string &name)
    {
      for (const BoundaryId id : all_boundary_ids)
        if (name.empty() ? number == static_cast<int>(id) : name == name_of(id))
          return id;
      return {};
    }

    // Number of the physical line of each id.
    std::map<BoundaryId, int> physical_lines()
    {
      std::map<BoundaryId, int> lines;
      gmsh::vectorpair          groups;
      gmsh::model::getPhysicalGroups(groups, 1);
      for (const auto &[dimension, number] : groups)
        {
          std::string name;
          gmsh::model::getPhysicalName(dimension, number, name);
          const auto id = boundary_id(number, name);
          if (!id)
            continue;
          if (!lines.emplace(*id, number).second)
            throw std::invalid_argument(std::string("two physical lines stand for ") + name_of(*id));
        }
      return lines;
    }

    // Tags of points that only a point element holds.
    std::set<std::size_t> construction_points()
    {
      const auto            points = element_vertices(gmsh_point);
      std::set<std::size_t> result(points.begin(), points.end());
      for (const int type : {gmsh_line, gmsh_quadrilateral})
        for (const std::size_t tag : element_vertices(type))
          result.erase(tag);
      return result;
    }

    using IndexOfTag = std::unordered_map<std::size_t, unsigned int>;

    // Fills the vertices of `mesh`; the answer gives their indices by gmsh's tags.
    IndexOfTag read_vertices(QuadMesh &mesh)
    {
      std::vector<std::size_t> tags;
      std::vector<double>      x, parameters;
      gmsh::model::mesh::getNodes(tags, x, parameters, -1, -1, false, false);
      const auto skipped = construction_points();
      IndexOfTag index;
      for (std::size_t i = 0; i < tags.size(); ++i)
        {
          if (skipped.count(tags[i]) > 0)
            continue;
          const Eigen::Vector3d p(x[3 * i], x[3 * i + 1], x[3 * i + 2]);
          if (!p.allFinite())
            throw std::invalid_argument("a coordinate of vertex " + std::to_string(tags[i]) + " is not finite");
          if (std::abs(p.z()) > 1e-9 * p.head<2>().norm())
            throw std::invalid_argument("vertex " + std::to_string(tags[i]) + " has z = " + std::to_string(p.z()) +
                                        "; the mesh must lie in the plane z = 0");
          index[tags[i]] = mesh.vertices.size();
          mesh.vertices.push_back(p.head<2>());
        }
      return index;
    }

    void read_lines(QuadMesh &mesh, const IndexOfTag &index)
    {
      for (const auto &[id, number] : physical_lines())
        {
          std::vector<int> entities;
          gmsh::model::getEntitiesForPhysicalGroup(1, number, entities);
          for (const int entity : entities)
            {
              const auto tags = element_vertices(gmsh_line, entity);
              for (std::size_t i = 0; i < tags.size(); i += 2)
                mesh.boundary.push_back({{index.at(tags[i]), index.at(tags[i + 1])}, id});
            }
        }
    }
  } // namespace

  GmshSession::GmshSession()
  {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
  }

  GmshSession::~GmshSession()
  {
    gmsh::finalize();
  }

  QuadMesh mesh_of_open_model()
  {
    check_element_types();
    QuadMesh   mesh;
    const auto index = read_vertices(mesh);
    const auto tags  = element_vertices(gmsh_quadrilateral);
    for (std::size_t i = 0; i < tags.size(); i += 4)
      mesh.cells.push_back({index.at(tags[i]), index.at(tags[i + 1]), index.at(tags[i + 2]), index.at(tags[i + 3])});
    read_lines(mesh, index);
    return mesh;
  }

  bool all_quadrilaterals()
  {
    std::vector<int> types;
    gmsh::model::mesh::getElementTypes(types, 2);
    return types == std::vector<int>{gmsh_quadrilateral};
  }
} // namespace diptych::continuum
