// diptych: all-quadrilateral mesh of a sample's outline
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/mesh.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>

#include <gmsh.h>

namespace diptych::continuum
{
  namespace
  {
    using Polyline = std::vector<Eigen::Vector2d>;

    constexpr int gmsh_line = 1, gmsh_quadrilateral = 3; // element types of gmsh

    // gmsh is a global: it lives as long as one call of ours, and is closed on every way out.
    struct GmshSession
    {
      GmshSession()
      {
        gmsh::initialize(0, nullptr, false);
        gmsh::option::setNumber("General.Terminal", 0);
      }
      ~GmshSession() { gmsh::finalize(); }
      GmshSession(const GmshSession &)            = delete;
      GmshSession &operator=(const GmshSession &) = delete;
    };

    // gmsh throws ints, strings or exceptions, depending on the place.
    template <class Action> auto guarded(const std::string &what, Action &&action)
    {
      try
        {
          return action();
        }
      catch (const std::exception &error)
        {
          throw std::runtime_error(what + ": " + error.what());
        }
      catch (const std::string &error)
        {
          throw std::runtime_error(what + ": gmsh says " + error);
        }
      catch (const int code)
        {
          throw std::runtime_error(what + ": gmsh failed with code " + std::to_string(code));
        }
    }

    void check_side(const Polyline &side, const char *name)
    {
      if (side.size() < 2)
        throw std::invalid_argument(std::string("outline: the ") + name + " side has fewer than two points");
      for (std::size_t i = 0; i < side.size(); ++i)
        if (!side[i].allFinite() || (i > 0 && side[i].y() <= side[i - 1].y()))
          throw std::invalid_argument(std::string("outline: the ") + name + " side must run upward; point " + std::to_string(i) +
                                      " does not");
    }

    double x_at(const Polyline &side, const double y)
    {
      const auto  above = std::upper_bound(side.begin() + 1, side.end() - 1, y,
                                           [](const double value, const Eigen::Vector2d &p) { return value < p.y(); });
      const auto &a = *(above - 1), &b = *above;
      return a.x() + (b.x() - a.x()) * (y - a.y()) / (b.y() - a.y());
    }

    void check_outline(const Outline &outline, const double element_size)
    {
      check_side(outline.left, "left");
      check_side(outline.right, "right");
      const double height = outline.left.back().y() - outline.left.front().y();
      for (const auto &[a, b, name] : {std::make_tuple(outline.left.front(), outline.right.front(), "lower"),
                                       std::make_tuple(outline.left.back(), outline.right.back(), "upper")})
        if (std::abs(a.y() - b.y()) > 1e-9 * height)
          throw std::invalid_argument(std::string("outline: the ") + name + " platen is not horizontal");
      for (const auto *side : {&outline.left, &outline.right})
        for (const auto &p : *side)
          if (x_at(outline.left, p.y()) >= x_at(outline.right, p.y()))
            throw std::invalid_argument("outline: the left side is not left of the right side at y = " + std::to_string(p.y()));
      if (!(element_size > 0) || element_size > 1.0001 * height)
        throw std::invalid_argument("element_size = " + std::to_string(element_size) +
                                    " must be positive and at most the height " + std::to_string(height));
    }

    // `n` pieces of equal arc length along the polyline.
    Polyline resampled(const Polyline &line, const unsigned int n)
    {
      std::vector<double> arc(1, 0.);
      for (std::size_t i = 1; i < line.size(); ++i)
        arc.push_back(arc.back() + (line[i] - line[i - 1]).norm());
      Polyline result{line.front()};
      for (unsigned int k = 1; k < n; ++k)
        {
          const double      target = arc.back() * k / n;
          const std::size_t i      = std::upper_bound(arc.begin(), arc.end(), target) - arc.begin();
          result.push_back(line[i - 1] + (line[i] - line[i - 1]) * (target - arc[i - 1]) / (arc[i] - arc[i - 1]));
        }
      result.push_back(line.back());
      return result;
    }

    unsigned int n_edges(const Polyline &line, const double element_size)
    {
      double length = 0;
      for (std::size_t i = 1; i < line.size(); ++i)
        length += (line[i] - line[i - 1]).norm();
      return std::max(1u, static_cast<unsigned int>(std::lround(length / element_size)));
    }

    // The four edges of the sample, each from left to right or upward, cut into element edges.
    std::map<unsigned int, Polyline> boundary_of(const Outline &outline, const double element_size)
    {
      std::map<unsigned int, Polyline>     edges{{lower_platen, {outline.left.front(), outline.right.front()}},
                                             {upper_platen, {outline.left.back(), outline.right.back()}},
                                             {left_side, outline.left},
                                             {right_side, outline.right}};
      std::map<unsigned int, unsigned int> n;
      unsigned int                         sum = 0;
      for (const auto &[id, line] : edges)
        sum += n[id] = n_edges(line, element_size);
      // A polygon with an odd number of edges has no all-quadrilateral mesh.
      if (sum % 2 == 1)
        ++n[left_side];
      for (auto &[id, line] : edges)
        line = resampled(line, n[id]);
      return edges;
    }

    // Lines of one edge as gmsh entities; points are shared through `points`.
    std::vector<int> add_lines(const Polyline &edge, const double element_size, std::map<std::pair<double, double>, int> &points)
    {
      std::vector<int> lines;
      int              previous = 0;
      for (const auto &p : edge)
        {
          auto [entry, is_new] = points.try_emplace({p.x(), p.y()}, 0);
          if (is_new)
            entry->second = gmsh::model::geo::addPoint(p.x(), p.y(), 0, element_size);
          if (previous != 0)
            {
              lines.push_back(gmsh::model::geo::addLine(previous, entry->second));
              gmsh::model::geo::mesh::setTransfiniteCurve(lines.back(), 2); // each piece is one element edge
            }
          previous = entry->second;
        }
      return lines;
    }

    void build_geometry(const Outline &outline, const double element_size)
    {
      gmsh::model::add("sample");
      std::map<std::pair<double, double>, int> points;
      std::map<unsigned int, std::vector<int>> lines;
      for (const auto &[id, edge] : boundary_of(outline, element_size))
        lines[id] = add_lines(edge, element_size, points);

      std::vector<int> loop = lines[lower_platen];
      loop.insert(loop.end(), lines[right_side].begin(), lines[right_side].end());
      for (const auto id : {upper_platen, left_side}) // these two run against the loop
        std::transform(lines[id].rbegin(), lines[id].rend(), std::back_inserter(loop), [](const int line) { return -line; });
      const int surface = gmsh::model::geo::addPlaneSurface({gmsh::model::geo::addCurveLoop(loop)});
      gmsh::model::geo::mesh::setRecombine(2, surface);
      gmsh::model::geo::synchronize();

      for (const auto &[id, name] : {std::make_pair(lower_platen, "lower_platen"), std::make_pair(upper_platen, "upper_platen"),
                                     std::make_pair(left_side, "left_side"), std::make_pair(right_side, "right_side")})
        {
          gmsh::model::addPhysicalGroup(1, lines[id], id);
          gmsh::model::setPhysicalName(1, id, name);
        }
      gmsh::model::addPhysicalGroup(2, {surface}, 1);
      gmsh::model::setPhysicalName(2, 1, "sample");
    }

    // Vertex lists of all elements of one type.
    std::vector<std::size_t> element_vertices(const int type)
    {
      std::vector<std::size_t> tags, vertices;
      gmsh::model::mesh::getElementsByType(type, tags, vertices);
      return vertices;
    }

    // All two-dimensional elements of the open model are quadrilaterals, and there is one.
    bool all_quadrilaterals()
    {
      std::vector<int> types;
      gmsh::model::mesh::getElementTypes(types, 2);
      return types == std::vector<int>{gmsh_quadrilateral};
    }

    std::map<std::size_t, Eigen::Vector2d> vertex_positions()
    {
      std::vector<std::size_t> tags;
      std::vector<double>      coordinates, parameters;
      gmsh::model::mesh::getNodes(tags, coordinates, parameters);
      std::map<std::size_t, Eigen::Vector2d> positions;
      for (std::size_t i = 0; i < tags.size(); ++i)
        positions[tags[i]] = {coordinates[3 * i], coordinates[3 * i + 1]};
      return positions;
    }

    MeshSummary summarise_open_mesh()
    {
      const auto  positions = vertex_positions();
      const auto  vertices  = element_vertices(gmsh_quadrilateral);
      MeshSummary summary;
      summary.n_cells       = vertices.size() / 4;
      summary.shortest_edge = std::numeric_limits<double>::max();
      std::set<std::size_t> used;
      for (std::size_t cell = 0; cell < vertices.size(); cell += 4)
        for (std::size_t k = 0; k < 4; ++k)
          {
            const auto  &a = positions.at(vertices[cell + k]), &b = positions.at(vertices[cell + (k + 1) % 4]);
            const double length = (b - a).norm();
            summary.area += (a.x() * b.y() - a.y() * b.x()) / 2;
            summary.shortest_edge = std::min(summary.shortest_edge, length);
            summary.longest_edge  = std::max(summary.longest_edge, length);
            used.insert(vertices[cell + k]);
          }
      summary.n_vertices = used.size();
      return summary;
    }

    // Smallest corner angle's sine over all quadrilaterals; not positive where one is folded or a triangle in disguise.
    double worst_corner()
    {
      const auto positions = vertex_positions();
      const auto vertices  = element_vertices(gmsh_quadrilateral);
      double     worst     = 1;
      for (std::size_t cell = 0; cell < vertices.size(); cell += 4)
        for (std::size_t k = 0; k < 4; ++k)
          {
            const Eigen::Vector2d p = positions.at(vertices[cell + k]);
            const Eigen::Vector2d a = positions.at(vertices[cell + (k + 1) % 4]) - p,
                                  b = positions.at(vertices[cell + (k + 3) % 4]) - p;
            worst                   = std::min(worst, (a.x() * b.y() - a.y() * b.x()) / (a.norm() * b.norm()));
          }
      return worst;
    }

    // gmsh's two-dimensional algorithms, in the order in which they are tried. The first makes right-angled triangles,
    // which recombine to the best quadrilaterals; Blossom pairs them all as long as a perfect pairing exists.
    struct Algorithm
    {
      int         code;
      const char *name;
    };
    constexpr Algorithm algorithms[] = {{6, "frontal Delaunay"}, {5, "Delaunay"}};

    const char *generate_quadrilaterals()
    {
      gmsh::option::setNumber("Mesh.RecombinationAlgorithm", 1); // Blossom
      gmsh::option::setNumber("Mesh.RandomSeed", 1);
      for (const auto &algorithm : algorithms)
        {
          gmsh::model::mesh::clear();
          gmsh::option::setNumber("Mesh.Algorithm", algorithm.code);
          gmsh::model::mesh::generate(2);
          if (all_quadrilaterals() && worst_corner() > 0.1)
            return algorithm.name;
        }
      throw std::runtime_error(
        "no algorithm of gmsh meshes this outline with sound quadrilaterals only; smooth the outline or change element_size");
    }

    std::map<std::pair<std::size_t, std::size_t>, int> outer_edges()
    {
      const auto                                         vertices = element_vertices(gmsh_quadrilateral);
      std::map<std::pair<std::size_t, std::size_t>, int> count;
      for (std::size_t cell = 0; cell < vertices.size(); cell += 4)
        for (std::size_t k = 0; k < 4; ++k)
          ++count[std::minmax(vertices[cell + k], vertices[cell + (k + 1) % 4])];
      for (auto edge = count.begin(); edge != count.end();)
        edge = edge->second == 1 ? std::next(edge) : count.erase(edge);
      return count;
    }

    // Every outer edge lies on one physical line with an id of BoundaryId, and every id occurs.
    void check_boundary()
    {
      auto edges = outer_edges();
      for (const int id : {lower_platen, upper_platen, left_side, right_side})
        {
          std::vector<int> entities;
          gmsh::model::getEntitiesForPhysicalGroup(1, id, entities);
          std::size_t n_lines = 0;
          for (const int entity : entities)
            {
              std::vector<std::size_t> tags, vertices;
              gmsh::model::mesh::getElementsByType(gmsh_line, tags, vertices, entity);
              for (std::size_t i = 0; i < vertices.size(); i += 2)
                n_lines += edges.erase(std::minmax(vertices[i], vertices[i + 1]));
            }
          if (n_lines == 0)
            throw std::runtime_error("no boundary edge has the physical id " + std::to_string(id) +
                                     " (1 lower platen, 2 upper platen, 3 left side, 4 right side)");
        }
      if (!edges.empty())
        throw std::runtime_error(std::to_string(edges.size()) + " boundary edges lie on none of the physical lines 1 to 4");
    }
  } // namespace

  MeshSummary make_mesh(const Outline &outline, const double element_size, const std::string &msh_file)
  {
    check_outline(outline, element_size);
    return guarded("meshing the outline", [&] {
      const GmshSession session;
      build_geometry(outline, element_size);
      const char *algorithm = generate_quadrilaterals();
      check_boundary();
      MeshSummary summary = summarise_open_mesh();
      summary.algorithm   = algorithm;

      gmsh::option::setNumber("Mesh.MshFileVersion", 2.2);
      const std::string temporary = msh_file + ".part.msh"; // gmsh chooses the format by the ending
      gmsh::write(temporary);
      if (!std::filesystem::exists(temporary))
        throw std::runtime_error("cannot write " + temporary);
      std::filesystem::rename(temporary, msh_file);
      return summary;
    });
  }

  MeshSummary check_mesh(const std::string &msh_file)
  {
    if (!std::filesystem::exists(msh_file))
      throw std::runtime_error("mesh file " + msh_file + " does not exist");
    return guarded(msh_file, [&] {
      const GmshSession session;
      gmsh::open(msh_file);
      if (!all_quadrilaterals())
        throw std::runtime_error("the mesh must consist of four-node quadrilaterals only, without triangles or higher order");
      check_boundary();
      return summarise_open_mesh();
    });
  }
} // namespace diptych::continuum
