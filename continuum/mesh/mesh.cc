// diptych: all-quadrilateral meshes: of a sample's outline, of a rectangle, or the user's own
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/mesh/mesh.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <map>
#include <stdexcept>

#include <gmsh.h>

#include "continuum/mesh/gmsh_model.h"
#include "continuum/mesh/mesh_child.h"

namespace diptych::continuum
{
  namespace
  {
    using Polyline = std::vector<Eigen::Vector2d>;

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

    bool is_straight_and_vertical(const Polyline &side)
    {
      const double tolerance = 1e-9 * (side.back().y() - side.front().y());
      return std::all_of(side.begin(), side.end(),
                         [&](const Eigen::Vector2d &p) { return std::abs(p.x() - side.front().x()) <= tolerance; });
    }

    // A polygon with an odd number of edges has no all-quadrilateral mesh. Sides that may be periodic stay equal.
    void make_even(std::map<unsigned int, unsigned int> &n, const bool equal_sides)
    {
      if (equal_sides)
        n[right_side] = n[left_side];
      if ((n[lower_platen] + n[upper_platen] + n[left_side] + n[right_side]) % 2 == 1)
        ++n[equal_sides ? upper_platen : left_side];
    }

    std::map<unsigned int, Polyline> boundary_of(const Outline &outline, const double element_size)
    {
      std::map<unsigned int, Polyline>     edges{{lower_platen, {outline.left.front(), outline.right.front()}},
                                             {upper_platen, {outline.left.back(), outline.right.back()}},
                                             {left_side, outline.left},
                                             {right_side, outline.right}};
      std::map<unsigned int, unsigned int> n;
      for (const auto &[id, line] : edges)
        n[id] = n_edges(line, element_size);
      make_even(n, is_straight_and_vertical(outline.left) && is_straight_and_vertical(outline.right));
      for (auto &[id, line] : edges)
        line = resampled(line, n[id]);
      return edges;
    }

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

      for (const auto &[id, entities] : lines)
        {
          gmsh::model::addPhysicalGroup(1, entities, id);
          gmsh::model::setPhysicalName(1, id, name_of(static_cast<BoundaryId>(id)));
        }
    }

    // gmsh's two-dimensional algorithms, in the order in which they are tried. The first makes right-angled triangles,
    // which recombine to the best quadrilaterals; Blossom pairs them all as long as a perfect pairing exists.
    constexpr int frontal_delaunay = 6, delaunay = 5;

    QuadMesh generate_quadrilaterals()
    {
      gmsh::option::setNumber("Mesh.RecombinationAlgorithm", 1); // Blossom
      gmsh::option::setNumber("Mesh.RandomSeed", 1);
      for (const int algorithm : {frontal_delaunay, delaunay})
        {
          gmsh::model::mesh::clear();
          gmsh::option::setNumber("Mesh.Algorithm", algorithm);
          gmsh::model::mesh::generate(2);
          if (!all_quadrilaterals())
            continue;
          QuadMesh mesh = mesh_of_open_model();
          if (worst_corner(mesh) > 0.1)
            return mesh;
        }
      throw std::runtime_error(
        "no algorithm of gmsh meshes this outline with sound quadrilaterals only; smooth the outline or change element_size");
    }

    QuadMesh mesh_through_gmsh(const std::string &file, const std::string &ending)
    {
      return guarded<std::invalid_argument>(file, [&] {
        const GmshSession session;
        gmsh::open(file);
        if (ending == ".geo")
          gmsh::model::mesh::generate(2);
        QuadMesh mesh = mesh_of_open_model();
        check(mesh);
        return mesh;
      });
    }
  } // namespace

  QuadMesh outline_mesh(const Outline &outline, const double element_size, const CheckStop &check_stop)
  {
    check_outline(outline, element_size);
    const auto make = [&] {
      return guarded<std::runtime_error>("meshing the outline", [&] {
        const GmshSession session;
        build_geometry(outline, element_size);
        QuadMesh mesh = generate_quadrilaterals();
        check(mesh);
        return mesh;
      });
    };
    return made_in_child(make, check_stop);
  }

  QuadMesh read_mesh(const std::string &file, const CheckStop &check_stop)
  {
    constexpr unsigned int most_cpu_seconds = 120; // a .geo script may have an endless loop
    const std::string      ending           = std::filesystem::path(file).extension().string();
    if (ending != ".msh" && ending != ".geo")
      throw std::invalid_argument(file + ": a mesh must be a .msh or .geo file");
    if (!std::filesystem::is_regular_file(file))
      throw std::invalid_argument(file + ": there is no such mesh file");
    try
      {
        return made_in_child([&] { return mesh_through_gmsh(file, ending); }, check_stop, most_cpu_seconds);
      }
    catch (const GmshEnded &end)
      {
        throw std::invalid_argument(file + ": " + end.what());
      }
  }
} // namespace diptych::continuum
