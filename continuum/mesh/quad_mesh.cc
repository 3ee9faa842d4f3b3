// diptych: a mesh of quadrilaterals as plain data, and its checks
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/mesh/quad_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>

namespace diptych::continuum
{
  namespace
  {
    using VertexPair = std::pair<unsigned int, unsigned int>;
    using CellOfEdge = std::map<VertexPair, unsigned int>; // edge as its cell runs along it -> cell

    constexpr double flat_corner = 1e-6; // sine of a corner below which a cell is no quadrilateral

    using Corners = std::array<Eigen::Vector2d, 4>;

    // Sines of the four corners: positive in a convex cell that runs counter-clockwise.
    std::array<double, 4> corner_sines(const Corners &corners)
    {
      std::array<double, 4> sines;
      for (unsigned int k = 0; k < 4; ++k)
        {
          const Eigen::Vector2d a = corners[(k + 1) % 4] - corners[k], b = corners[(k + 3) % 4] - corners[k];
          const double          lengths = a.norm() * b.norm();
          sines[k]                      = lengths > 0 ? (a.x() * b.y() - a.y() * b.x()) / lengths : 0.;
        }
      return sines;
    }

    Corners corners_of(const QuadMesh &mesh, const std::array<unsigned int, 4> &cell)
    {
      return {mesh.vertices[cell[0]], mesh.vertices[cell[1]], mesh.vertices[cell[2]], mesh.vertices[cell[3]]};
    }

    std::string at(const Eigen::Vector2d &p)
    {
      std::ostringstream out;
      out << " at (" << p.x() << ", " << p.y() << ")";
      return out.str();
    }

    std::string at_middle(const QuadMesh &mesh, const VertexPair &edge)
    {
      return at((mesh.vertices[edge.first] + mesh.vertices[edge.second]) / 2);
    }

    void check_cells(const QuadMesh &mesh)
    {
      if (mesh.cells.empty())
        throw std::invalid_argument("the mesh holds no quadrilateral");
      for (const auto &cell : mesh.cells)
        {
          const Turn turn = turn_of(corners_of(mesh, cell));
          if (turn == Turn::counter_clockwise)
            continue;
          throw std::invalid_argument(
            "a cell is " +
            std::string(turn == Turn::clockwise ? "clockwise (reverse the surface in gmsh)" : "folded, concave or flat") +
            at(mesh.vertices[cell[0]]));
        }
    }

    // Neighbours run along their common edge in opposite directions, so no directed edge occurs twice.
    CellOfEdge directed_edges(const QuadMesh &mesh)
    {
      CellOfEdge edges;
      for (unsigned int cell = 0; cell < mesh.cells.size(); ++cell)
        for (unsigned int k = 0; k < 4; ++k)
          {
            const VertexPair edge{mesh.cells[cell][k], mesh.cells[cell][(k + 1) % 4]};
            if (!edges.emplace(edge, cell).second)
              throw std::invalid_argument("two cells overlap" + at_middle(mesh, edge));
          }
      return edges;
    }

    void check_one_piece(const QuadMesh &mesh, const CellOfEdge &edges)
    {
      std::vector<char>         reached(mesh.cells.size(), 0);
      std::vector<unsigned int> front{0};
      reached[0] = 1;
      while (!front.empty())
        {
          const auto cell = mesh.cells[front.back()];
          front.pop_back();
          for (unsigned int k = 0; k < 4; ++k)
            if (const auto neighbour = edges.find({cell[(k + 1) % 4], cell[k]});
                neighbour != edges.end() && !reached[neighbour->second])
              {
                reached[neighbour->second] = 1;
                front.push_back(neighbour->second);
              }
        }
      if (const auto lost = std::find(reached.begin(), reached.end(), 0); lost != reached.end())
        throw std::invalid_argument("the mesh has more than one piece; cells of different pieces share no edge, one lies" +
                                    at(mesh.vertices[mesh.cells[lost - reached.begin()][0]]));
    }

    void check_vertices(const QuadMesh &mesh)
    {
      std::vector<char> used(mesh.vertices.size(), 0);
      for (const auto &cell : mesh.cells)
        for (const unsigned int vertex : cell)
          used[vertex] = 1;
      if (const auto unused = std::find(used.begin(), used.end(), 0); unused != used.end())
        throw std::invalid_argument("a vertex belongs to no cell" + at(mesh.vertices[unused - used.begin()]));
    }

    std::set<VertexPair> outer_edges(const CellOfEdge &edges)
    {
      std::set<VertexPair> outer;
      for (const auto &[edge, cell] : edges)
        if (edges.count({edge.second, edge.first}) == 0)
          outer.insert(std::minmax(edge.first, edge.second));
      return outer;
    }

    void check_boundary(const QuadMesh &mesh, const CellOfEdge &edges)
    {
      const auto                       outer = outer_edges(edges);
      std::map<VertexPair, BoundaryId> line_of;
      std::set<BoundaryId>             present;
      for (const auto &[vertices, id] : mesh.boundary)
        {
          const VertexPair edge = std::minmax(vertices[0], vertices[1]);
          if (outer.count(edge) == 0)
            throw std::invalid_argument(std::string("the physical line ") + name_of(id) + " leaves the boundary of the mesh" +
                                        at_middle(mesh, edge));
          if (const auto [other, is_new] = line_of.emplace(edge, id); !is_new)
            throw std::invalid_argument(std::string("an edge lies on two physical lines, ") + name_of(other->second) + " and " +
                                        name_of(id) + at_middle(mesh, edge) +
                                        " (in MSH 2.2 no two physical lines may share an elementary entity)");
          present.insert(id);
        }
      for (const BoundaryId id : all_boundary_ids)
        if (id != free_edge && present.count(id) == 0)
          throw std::invalid_argument(std::string("no boundary edge lies on the physical line ") + name_of(id) + " (number " +
                                      std::to_string(id) + " where lines have no names)");
      for (const VertexPair &edge : outer)
        if (line_of.count(edge) == 0)
          throw std::invalid_argument(std::to_string(outer.size() - line_of.size()) +
                                      " boundary edges lie on no physical line, one of them" + at_middle(mesh, edge));
    }

    std::vector<double> heights(const QuadMesh &mesh, const BoundaryId id)
    {
      std::set<unsigned int> vertices;
      for (const auto &edge : mesh.boundary)
        if (edge.id == id)
          vertices.insert(edge.vertices.begin(), edge.vertices.end());
      std::vector<double> result;
      for (const unsigned int vertex : vertices)
        result.push_back(mesh.vertices[vertex].y());
      std::sort(result.begin(), result.end());
      return result;
    }

    double height(const QuadMesh &mesh)
    {
      const auto [lowest, highest] = std::minmax_element(mesh.vertices.begin(), mesh.vertices.end(),
                                                         [](const auto &a, const auto &b) { return a.y() < b.y(); });
      return highest->y() - lowest->y();
    }

    double upper_platen_width(const QuadMesh &mesh)
    {
      double low = std::numeric_limits<double>::max(), high = -low;
      for (const auto &edge : mesh.boundary)
        if (edge.id == upper_platen)
          for (const unsigned int vertex : edge.vertices)
            {
              low  = std::min(low, mesh.vertices[vertex].x());
              high = std::max(high, mesh.vertices[vertex].x());
            }
      return high - low;
    }

    bool sides_match(const QuadMesh &mesh)
    {
      const double tolerance = 1e-9 * height(mesh);
      const auto   left = heights(mesh, left_side), right = heights(mesh, right_side);
      return std::equal(left.begin(), left.end(), right.begin(), right.end(),
                        [&](const double a, const double b) { return std::abs(a - b) <= tolerance; });
    }
  } // namespace

  const char *name_of(const BoundaryId id)
  {
    constexpr const char *names[] = {"lower_platen", "upper_platen", "left_side", "right_side", "free"};
    return names[id - lower_platen];
  }

  Turn turn_of(const std::array<Eigen::Vector2d, 4> &corners)
  {
    const auto sines = corner_sines(corners);
    if (std::all_of(sines.begin(), sines.end(), [](const double s) { return s > flat_corner; }))
      return Turn::counter_clockwise;
    if (std::all_of(sines.begin(), sines.end(), [](const double s) { return s < -flat_corner; }))
      return Turn::clockwise;
    return Turn::folded;
  }

  void check(const QuadMesh &mesh)
  {
    check_cells(mesh);
    const CellOfEdge edges = directed_edges(mesh);
    check_one_piece(mesh, edges);
    check_vertices(mesh);
    check_boundary(mesh, edges);
  }

  MeshSummary summarise(const QuadMesh &mesh)
  {
    MeshSummary summary;
    summary.n_cells       = mesh.cells.size();
    summary.n_vertices    = mesh.vertices.size();
    summary.shortest_edge = std::numeric_limits<double>::max();
    summary.height        = height(mesh);
    summary.platen_width  = upper_platen_width(mesh);
    summary.sides_match   = sides_match(mesh);
    for (const auto &cell : mesh.cells)
      for (unsigned int k = 0; k < 4; ++k)
        {
          const Eigen::Vector2d &a = mesh.vertices[cell[k]], &b = mesh.vertices[cell[(k + 1) % 4]];
          const double           length = (b - a).norm();
          summary.area += (a.x() * b.y() - a.y() * b.x()) / 2;
          summary.shortest_edge = std::min(summary.shortest_edge, length);
          summary.longest_edge  = std::max(summary.longest_edge, length);
        }
    return summary;
  }

  double worst_corner(const QuadMesh &mesh)
  {
    double worst = 1;
    for (const auto &cell : mesh.cells)
      for (const double sine : corner_sines(corners_of(mesh, cell)))
        worst = std::min(worst, sine);
    return worst;
  }
} // namespace diptych::continuum
