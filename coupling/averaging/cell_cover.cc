// diptych: the number of grains in a cell and the area that they cover
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/averaging/cell_cover.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "coupling/cells/cross_product.h"

namespace diptych::coupling
{
  namespace
  {
    // Signed area of the part of a disc about the origin inside the triangle origin-a-b. It is a triangle where a-b runs inside
    // the disc, and a sector where a-b runs outside.
    double disc_edge_area(const double radius, const Eigen::Vector2d &a, const Eigen::Vector2d &b)
    {
      const auto sector = [radius](const Eigen::Vector2d &u, const Eigen::Vector2d &v) {
        return 0.5 * radius * radius * std::atan2(cross(u, v), u.dot(v));
      };
      // |a + t (b - a)|^2 = radius^2
      const Eigen::Vector2d d            = b - a;
      const double          half_linear  = a.dot(d);
      const double          quadratic    = d.squaredNorm();
      const double          discriminant = half_linear * half_linear - quadratic * (a.squaredNorm() - radius * radius);
      if (!(discriminant > 0))
        return sector(a, b);
      const double root = std::sqrt(discriminant);
      const double from = std::max((-half_linear - root) / quadratic, 0.);
      const double to   = std::min((-half_linear + root) / quadratic, 1.);
      if (from >= to)
        return sector(a, b);
      const Eigen::Vector2d enter = a + from * d, leave = a + to * d;
      return (from > 0 ? sector(a, enter) : 0) + 0.5 * cross(enter, leave) + (to < 1 ? sector(leave, b) : 0);
    }

    double weighted_median(const std::vector<double> &value, const std::vector<double> &weight)
    {
      std::vector<std::size_t> order(value.size());
      std::iota(order.begin(), order.end(), 0);
      std::stable_sort(order.begin(), order.end(), [&](const auto a, const auto b) { return value[a] < value[b]; });
      const double half = 0.5 * std::accumulate(weight.begin(), weight.end(), 0.);
      double       sum  = 0;
      for (const std::size_t k : order)
        if ((sum += weight[k]) >= half)
          return value[k];
      return 0;
    }
  } // namespace

  double disc_polygon_area(const Eigen::Vector2d &centre, const double radius, const std::vector<Eigen::Vector2d> &polygon)
  {
    double area = 0;
    for (std::size_t k = 0; k < polygon.size(); ++k)
      area += disc_edge_area(radius, polygon[k] - centre, polygon[(k + 1) % polygon.size()] - centre);
    return area;
  }

  CellCover cell_cover(const QuadMesh                     &mesh,
                       const TriangleSearch               &search,
                       const std::vector<Eigen::Vector2d> &position,
                       const std::vector<double>          &radius)
  {
    if (radius.size() != position.size())
      throw std::invalid_argument("the cover of the cells needs one radius per grain");

    CellCover cover;
    cover.grain_count.assign(mesh.cell.size(), 0);
    std::vector<double>          disc_area(mesh.cell.size(), 0.);
    std::vector<unsigned int>    triangles;
    std::vector<Eigen::Vector2d> polygon;
    const auto                   outlines = cell_outlines(mesh);
    for (std::size_t i = 0; i < position.size(); ++i)
      {
        const auto place = search.locate(position[i]);
        if (place.inside)
          ++cover.grain_count[mesh.triangle[place.triangle].cell];

        const Eigen::Vector2d extent = Eigen::Vector2d::Constant(radius[i]);
        search.triangles_in_box(position[i] - extent, position[i] + extent, triangles);
        for (std::size_t k = 0; k < triangles.size(); ++k)
          {
            const unsigned int cell = mesh.triangle[triangles[k]].cell;
            if (k > 0 && mesh.triangle[triangles[k - 1]].cell == cell)
              continue;
            polygon.clear();
            for (const unsigned int node : outlines[cell])
              polygon.push_back(mesh.node[node]);
            disc_area[cell] += disc_polygon_area(position[i], radius[i], polygon);
          }
      }

    const std::vector<double> areas = cell_areas(mesh);
    std::vector<double>       weight(areas.size());
    cover.solid_fraction.resize(areas.size());
    for (std::size_t c = 0; c < areas.size(); ++c)
      {
        cover.solid_fraction[c] = std::max(0., disc_area[c] / areas[c]);
        weight[c]               = cover.solid_fraction[c] > 1e-12 ? areas[c] : 0;
      }
    cover.typical_solid_fraction = weighted_median(cover.solid_fraction, weight);
    cover.covered.resize(areas.size());
    for (std::size_t c = 0; c < areas.size(); ++c)
      cover.covered[c] = cover.solid_fraction[c] > 0 && cover.solid_fraction[c] >= 0.5 * cover.typical_solid_fraction;
    return cover;
  }
} // namespace diptych::coupling
