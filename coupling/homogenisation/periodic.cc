// diptych: grains of one stage mapped onto cells, across the edge of a periodic sample, too
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/homogenisation/periodic.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace diptych::coupling
{
  namespace
  {
    constexpr int images[] = {0, -1, 1};

    MappedMoment folded(const MappedMoment &mapped, const std::size_t n_triangles)
    {
      MappedMoment result = mapped;
      result.triangle_moment.assign(n_triangles, Eigen::Matrix2d::Zero());
      for (std::size_t t = 0; t < mapped.triangle_moment.size(); ++t)
        result.triangle_moment[t % n_triangles] += mapped.triangle_moment[t];
      return result;
    }

    // Euler: nodes - edges + cells = 1 for a sample without holes; a hanging node has one edge more.
    bool has_hanging_nodes(const QuadMesh &mesh)
    {
      std::set<std::pair<unsigned int, unsigned int>> edges;
      for (const auto &cell : mesh.cell)
        for (unsigned int k = 0; k < 4; ++k)
          edges.insert(std::minmax(cell[k], cell[(k + 1) % 4]));
      return mesh.node.size() + mesh.cell.size() != edges.size() + 1;
    }

    double nodal_residual(const QuadMesh           &mesh,
                          const TriangleSearch     &search,
                          const discrete::Snapshot &s,
                          const MappedMoment       &mapped)
    {
      const auto a = nodal_forces(mesh, mapped), b = nodal_contact_forces(mesh, search, s.position, s.window_forces);
      double     difference = 0, norm = 0;
      for (std::size_t k = 0; k < a.size(); ++k)
        difference += (a[k] - b[k]).squaredNorm(), norm += b[k].squaredNorm();
      return norm > 0 ? std::sqrt(difference / norm) : NAN;
    }
  } // namespace

  QuadMesh tiled(const QuadMesh &mesh, const double period)
  {
    QuadMesh result;
    for (const int image : images)
      {
        const unsigned int first = result.node.size();
        for (const Eigen::Vector2d &x : mesh.node)
          result.node.emplace_back(x.x() + image * period, x.y());
        for (auto cell : mesh.cell)
          {
            for (unsigned int &node : cell)
              node += first;
            result.cell.push_back(cell);
          }
      }
    return result;
  }

  MappedGrains map_grains(const QuadMesh &mesh, const discrete::Snapshot &grains)
  {
    const bool           periodic = grains.cell_width > 0;
    const QuadMesh       images   = periodic ? tiled(mesh, grains.cell_width) : mesh;
    const TriangleSearch search(images);
    MappedGrains         result{map_segments(images, search, grains.position, grains.window_forces), NAN};
    if (!periodic && !has_hanging_nodes(mesh))
      result.nodal_residual = nodal_residual(mesh, search, grains, result.moment);
    add_spin_term(search, grains.position, grains.mean_spin_term, result.moment);
    result.moment = folded(result.moment, 2 * mesh.cell.size());
    return result;
  }

  CellCover grain_cover(const QuadMesh &mesh, const discrete::Snapshot &grains)
  {
    if (!(grains.cell_width > 0))
      return cell_cover(mesh, TriangleSearch(mesh), grains.position, grains.radius);
    std::vector<Eigen::Vector2d> position;
    std::vector<double>          radius;
    for (const int image : images)
      {
        for (const Eigen::Vector2d &x : grains.position)
          position.emplace_back(x.x() + image * grains.cell_width, x.y());
        radius.insert(radius.end(), grains.radius.begin(), grains.radius.end());
      }
    return cell_cover(mesh, TriangleSearch(mesh), position, radius);
  }
} // namespace diptych::coupling
