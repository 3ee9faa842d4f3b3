// diptych: a ring of triangles around a mesh, where linear shape functions continue for branches that leave the mesh
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/averaging/collar.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "coupling/averaging/star_shape.h"

namespace diptych::coupling
{
  namespace
  {
    double mean_length(const QuadMesh &mesh, const std::vector<BoundaryEdge> &boundary)
    {
      double sum = 0;
      for (const auto &edge : boundary)
        sum += (mesh.node[edge.to] - mesh.node[edge.from]).norm();
      return sum / boundary.size();
    }

    // Joins every edge to the images of its ends by two triangles. `image` places the images. Returns the image of every node.
    template <class Image>
    std::map<unsigned int, unsigned int> add_collar(const std::vector<BoundaryEdge> &edges,
                                                    const Image                     &image,
                                                    CollaredMesh                    &collared)
    {
      QuadMesh                            &mesh = collared.mesh;
      std::map<unsigned int, unsigned int> image_of;
      const auto                           image_node = [&](const unsigned int node) {
        const auto [entry, is_new] = image_of.try_emplace(node, mesh.node.size());
        if (is_new)
          {
            mesh.node.push_back(image(mesh.node[node]));
            collared.same_as.push_back(entry->second);
          }
        return entry->second;
      };
      for (const auto &edge : edges)
        {
          const unsigned int from = image_node(edge.from), to = image_node(edge.to), cell = mesh.triangle[edge.triangle].cell;
          mesh.triangle.push_back({{{edge.to, edge.from, from}}, cell});
          mesh.triangle.push_back({{{edge.to, from, to}}, cell});
          collared.receiver.insert(collared.receiver.end(), 2, edge.triangle);
        }
      return image_of;
    }

    struct PeriodicBoundary
    {
      std::map<unsigned int, unsigned int> left; // the left node that belongs to each node of the right side
      std::vector<BoundaryEdge>            lower, upper;
    };

    std::optional<PeriodicBoundary> periodic_boundary(const QuadMesh &mesh, const double period)
    {
      const std::vector<BoundaryEdge>                 boundary = boundary_edges(mesh);
      std::set<std::pair<unsigned int, unsigned int>> edges;
      for (const auto &edge : boundary)
        edges.emplace(edge.from, edge.to);
      const std::vector<unsigned int> same = same_nodes(mesh, period, 1e-6 * period);
      PeriodicBoundary                result;
      for (unsigned int node = 0; node < same.size(); ++node)
        if (same[node] != node)
          result.left[node] = same[node];

      std::set<std::pair<unsigned int, unsigned int>> sides;
      std::map<unsigned int, unsigned int>            on_side;
      for (const auto &[from, to] : edges)
        if (const auto a = result.left.find(from), b = result.left.find(to); a != result.left.end() && b != result.left.end())
          if (const std::pair<unsigned int, unsigned int> opposite(b->second, a->second); edges.count(opposite) > 0)
            {
              sides.insert({{from, to}, opposite});
              on_side.insert({*a, *b});
            }
      result.left = on_side;

      double lower_width = 0, upper_width = 0;
      for (const auto &edge : boundary)
        if (sides.count({edge.from, edge.to}) == 0)
          {
            const double along = mesh.node[edge.to].x() - mesh.node[edge.from].x();
            if (along == 0)
              return std::nullopt;
            (along > 0 ? lower_width : upper_width) += std::abs(along);
            (along > 0 ? result.lower : result.upper).push_back(edge);
          }
      if (std::abs(lower_width - period) > 1e-6 * period || std::abs(upper_width - period) > 1e-6 * period)
        return std::nullopt;
      return result;
    }

    // The images one period apart. They share the nodes of their sides. The inner triangles of all images come first.
    CollaredMesh periodic_images(const CollaredMesh &one, const double period, const std::map<unsigned int, unsigned int> &left)
    {
      const unsigned int        n_nodes = one.mesh.node.size();
      std::vector<unsigned int> partner(n_nodes, n_nodes);
      for (const auto &[right, other] : left)
        partner[right] = other;

      CollaredMesh result;
      result.n_inner         = 3 * one.n_inner;
      constexpr int images[] = {0, 1, -1, 2}; // images of nodes; the last serves the right side of image 1
      for (const int image : images)
        for (unsigned int n = 0; n < n_nodes; ++n)
          {
            result.mesh.node.emplace_back(one.mesh.node[n].x() + image * period, one.mesh.node[n].y());
            result.same_as.push_back(partner[n] < n_nodes ? partner[n] : n);
          }
      constexpr unsigned int next[] = {1, 3, 0}; // index in `images` of the right neighbour
      const auto             add    = [&](const std::size_t begin, const std::size_t end) {
        for (unsigned int image = 0; image < 3; ++image)
          for (std::size_t t = begin; t < end; ++t)
            {
              CellTriangle triangle = one.mesh.triangle[t];
              for (unsigned int &node : triangle.node)
                node = partner[node] < n_nodes ? next[image] * n_nodes + partner[node] : image * n_nodes + node;
              result.mesh.triangle.push_back(triangle);
              result.receiver.push_back(one.receiver[t]);
            }
      };
      add(0, one.n_inner);
      add(one.n_inner, one.mesh.triangle.size());
      return result;
    }

    CollaredMesh without_collar(const QuadMesh &mesh, const double period)
    {
      CollaredMesh result{mesh, {}, {}, mesh.triangle.size()};
      result.receiver.resize(mesh.triangle.size());
      std::iota(result.receiver.begin(), result.receiver.end(), 0);
      result.same_as.resize(mesh.node.size());
      std::iota(result.same_as.begin(), result.same_as.end(), 0);
      return period > 0 ? periodic_images(result, period, {}) : result;
    }

    // The mesh in a cell that is periodic in both directions. It fills the plane if every edge of its boundary is also, in the
    // opposite direction, one of the opposite side, and its area is that of the cell.
    CollaredMesh on_lattice(const QuadMesh &mesh, const Period &period)
    {
      const double                                    cell     = std::abs(period.vectors.determinant());
      const std::vector<unsigned int>                 same     = same_nodes(mesh, period, 1e-6 * std::sqrt(cell));
      const std::vector<BoundaryEdge>                 boundary = boundary_edges(mesh);
      std::set<std::pair<unsigned int, unsigned int>> edges;
      for (const auto &edge : boundary)
        edges.emplace(same[edge.from], same[edge.to]);
      const std::vector<double> areas = cell_areas(mesh);

      CollaredMesh result{tiled(mesh, period), {}, {}, 0};
      result.n_inner   = result.mesh.triangle.size();
      result.is_closed = std::abs(std::accumulate(areas.begin(), areas.end(), 0.) - cell) < 1e-6 * cell &&
                         std::all_of(boundary.begin(), boundary.end(), [&](const BoundaryEdge &edge) {
                           return edges.count({same[edge.to], same[edge.from]}) > 0;
                         });
      for (unsigned int t = 0; t < result.n_inner; ++t)
        {
          result.receiver.push_back(t % mesh.triangle.size());
          result.mesh.triangle[t].cell %= mesh.cell.size();
        }
      for (unsigned int node = 0; node < result.mesh.node.size(); ++node)
        result.same_as.push_back(same[node % mesh.node.size()]);
      return result;
    }
  } // namespace

  std::optional<CollaredMesh> with_collar(const QuadMesh &mesh, const std::vector<Eigen::Vector2d> &points)
  {
    const std::vector<BoundaryEdge> boundary = boundary_edges(mesh);
    const std::optional<StarShape>  star     = star_shape(mesh, boundary);
    if (!star)
      return std::nullopt;
    double reach = 1;
    for (const Eigen::Vector2d &point : points)
      reach = std::max(reach, gauge(*star, mesh, point));
    if (!std::isfinite(reach))
      return std::nullopt;
    CollaredMesh result = without_collar(mesh, 0);
    // Half an edge is added because between two points the scaled boundary may lie further in where it is not convex.
    const double scale = reach + 0.5 * mean_length(mesh, boundary) / star->clearance;
    add_collar(
      boundary, [&](const Eigen::Vector2d &x) { return Eigen::Vector2d(star->centre + scale * (x - star->centre)); }, result);
    result.is_closed = true;
    return result;
  }

  std::optional<CollaredMesh> with_periodic_collar(const QuadMesh                     &mesh,
                                                   const double                        period,
                                                   const std::vector<Eigen::Vector2d> &points)
  {
    std::optional<PeriodicBoundary> boundary = periodic_boundary(mesh, period);
    if (!boundary)
      return std::nullopt;
    double bottom = -std::numeric_limits<double>::infinity(), top = -bottom; // heights at which the collar may have to begin
    for (const auto &edge : boundary->lower)
      bottom = std::max(bottom, mesh.node[edge.from].y());
    for (const auto &edge : boundary->upper)
      top = std::min(top, mesh.node[edge.from].y());
    double below = 0, above = 0;
    for (const Eigen::Vector2d &point : points)
      {
        below = std::max(below, bottom - point.y());
        above = std::max(above, point.y() - top);
      }

    CollaredMesh result = without_collar(mesh, 0);
    const auto   add    = [&](const std::vector<BoundaryEdge> &edges, const double shift) {
      const auto image = add_collar(
             edges, [&](const Eigen::Vector2d &x) { return Eigen::Vector2d(x.x(), x.y() + shift); }, result);
      for (const auto &edge : edges) // for the two ends of the chain, which lie on the sides
        for (const unsigned int node : {edge.from, edge.to})
          if (const auto partner = boundary->left.find(node); partner != boundary->left.end())
            boundary->left[image.at(node)] = image.at(partner->second);
    };
    add(boundary->lower, -below - mean_length(mesh, boundary->lower));
    add(boundary->upper, above + mean_length(mesh, boundary->upper));
    result           = periodic_images(result, period, boundary->left);
    result.is_closed = true;
    return result;
  }

  CollaredMesh ground_of(const QuadMesh &mesh, const Period &period, const std::vector<Eigen::Vector2d> &points)
  {
    if (period.both())
      return on_lattice(mesh, period);
    const double width  = period.vectors(0, 0);
    auto         ground = width > 0 ? with_periodic_collar(mesh, width, points) : with_collar(mesh, points);
    return ground ? *std::move(ground) : without_collar(mesh, width);
  }

  double largest_difference(const CollaredMesh                 &cells,
                            const std::vector<Eigen::Vector2d> &a,
                            const std::vector<Eigen::Vector2d> &b)
  {
    std::vector<Eigen::Vector2d> difference(a.size(), Eigen::Vector2d::Zero());
    for (std::size_t k = 0; k < a.size(); ++k)
      difference[cells.same_as[k]] += a[k] - b[k];
    double largest = 0;
    for (const Eigen::Vector2d &d : difference)
      largest = std::max(largest, d.norm());
    return largest;
  }
} // namespace diptych::coupling
