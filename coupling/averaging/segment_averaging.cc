// diptych: averaging by segments: branches and discs cut by the cells
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <cmath>
#include <numeric>

#include "coupling/averaging/averaging_methods.h"
#include "coupling/averaging/collar.h"
#include "coupling/averaging/disc_part.h"

namespace diptych::coupling
{
  namespace
  {
    std::vector<std::vector<Eigen::Vector2d>> cell_polygons(const QuadMesh &mesh)
    {
      std::vector<std::vector<Eigen::Vector2d>> polygons;
      polygons.reserve(mesh.cell.size());
      for (const auto &outline : cell_outlines(mesh))
        {
          polygons.emplace_back();
          for (const unsigned int node : outline)
            polygons.back().push_back(mesh.node[node]);
        }
      return polygons;
    }

    // Exact areas of the discs in the cells. What lies outside goes to the boundary cell nearest to its own centroid, which the
    // inside parts tell: the first moments of both about the centre add up to zero.
    GrainShares disc_shares(const TargetCells &target, const Carriers &carriers)
    {
      const auto                polygons = cell_polygons(target.images);
      GrainShares               shares;
      std::vector<unsigned int> triangles;
      for (std::size_t i = 0; i < carriers.position.size(); ++i)
        {
          const double           radius = carriers.radius[i], full = M_PI * radius * radius;
          const Eigen::Vector2d &x      = carriers.position[i];
          const Eigen::Vector2d  extent = Eigen::Vector2d::Constant(radius);
          target.search.triangles_in_box(x - extent, x + extent, triangles);
          DiscPart inside;
          for (std::size_t k = 0; k < triangles.size(); ++k)
            {
              const unsigned int cell = target.images.triangle[triangles[k]].cell;
              if (k > 0 && target.images.triangle[triangles[k - 1]].cell == cell)
                continue;
              const DiscPart part = disc_part(x, radius, polygons[cell]);
              if (std::abs(part.area) < 1e-14 * full)
                continue; // apart: sectors that cancel
              inside.area += part.area;
              inside.moment += part.moment;
              shares.add(cell % target.n_cells(), part.area / full);
            }
          const double rest = full - inside.area;
          if (rest > 1e-12 * full)
            shares.add(target.cell_of(target.search.locate(x - inside.moment / rest).triangle), rest / full);
          shares.end_row(false);
        }
      return shares;
    }

    // Part of a tapered quantity between the parameters from and to: integral of 2 (1 - t).
    double tapered_share(const double from, const double to)
    {
      return (to - from) * (2 - to - from);
    }

    // The mesh with the collar that all halves lie inside, so that cells at the boundary get what map_grains() gives them.
    CollaredMesh ground_of(const TargetCells &target, const Carriers &carriers)
    {
      std::vector<Eigen::Vector2d> ends;
      for (const HalfBranch &half : carriers.half)
        {
          ends.push_back(carriers.position[half.grain]);
          ends.push_back(ends.back() + half.vector);
        }
      auto ground = target.period > 0 ? with_periodic_collar(target.mesh, target.period, ends) : with_collar(target.mesh, ends);
      return ground ? *std::move(ground) : without_collar(target.mesh, target.period);
    }

    // Both sides of the nodal identity, filled while the halves are cut.
    struct NodalIdentity
    {
      const CollaredMesh          &ground;
      const TriangleSearch        &search;
      std::vector<Eigen::Matrix2d> triangle_moment = std::vector<Eigen::Matrix2d>(ground.mesh.triangle.size(),
                                                                                  Eigen::Matrix2d::Zero());
      std::vector<Eigen::Vector2d> difference    = std::vector<Eigen::Vector2d>(ground.mesh.node.size(), Eigen::Vector2d::Zero());
      double                       largest_force = 0;
      bool                         left          = false; // a half lay beyond the ground

      void add_force(const Eigen::Vector2d &force, const Eigen::Vector2d &at)
      {
        const unsigned int triangle = search.locate(at).triangle;
        const auto         node     = triangle_nodes(ground.mesh, triangle);
        const auto         value    = shape_values(ground.mesh, triangle, at);
        for (unsigned int k = 0; k < 3; ++k)
          difference[ground.same_as[node[k]]] -= value[k] * force;
      }

      double residual()
      {
        if (left || ground.n_inner == ground.mesh.triangle.size() || largest_force == 0)
          return NAN;
        for (unsigned int t = 0; t < triangle_moment.size(); ++t)
          {
            const auto node     = triangle_nodes(ground.mesh, t);
            const auto gradient = shape_gradients(ground.mesh, t);
            for (unsigned int k = 0; k < 3; ++k)
              difference[ground.same_as[node[k]]] += triangle_moment[t] * gradient.col(k);
          }
        double largest = 0;
        for (const Eigen::Vector2d &d : difference)
          largest = std::max(largest, d.norm());
        return largest / largest_force;
      }
    };

    // Adds the halves to the sums.
    void cut_halves(const TargetCells &target, const Carriers &carriers, CellSums &sums)
    {
      const bool uniform = carriers.uniform.cols() > 0, tapered = carriers.tapered.cols() > 0,
                 judged                          = !carriers.half_force.empty();
      double                             outside = 0;
      const CollaredMesh                 ground  = ground_of(target, carriers);
      const TriangleSearch               search(ground.mesh);
      NodalIdentity                      identity{ground, search};
      std::vector<TriangleSearch::Piece> pieces;
      for (std::size_t h = 0; h < carriers.half.size(); ++h)
        {
          const Eigen::Index     row  = Eigen::Index(h);
          const Eigen::Vector2d &from = carriers.position[carriers.half[h].grain], to = from + carriers.half[h].vector;
          search.cut(from, to, pieces);
          for (const TriangleSearch::Piece &piece : pieces)
            {
              const unsigned int cell  = target.mesh.triangle[ground.receiver[piece.triangle]].cell;
              const double       share = piece.to - piece.from;
              if (uniform)
                sums.uniform.row(cell) += share * carriers.uniform.row(row);
              if (tapered)
                sums.tapered.row(cell) += tapered_share(piece.from, piece.to) * carriers.tapered.row(row);
              if (!piece.inside || piece.triangle >= ground.n_inner)
                outside += share * carriers.half_size[h];
              if (judged)
                {
                  const auto moment = carriers.uniform.row(row);
                  identity.triangle_moment[piece.triangle] +=
                    share * (Eigen::Matrix2d() << moment[0], moment[1], moment[2], moment[3]).finished();
                  identity.left = identity.left || (!piece.inside && !carriers.half_force[h].isZero(0));
                }
            }
          if (judged && !carriers.half_force[h].isZero(0))
            {
              identity.largest_force = std::max(identity.largest_force, carriers.half_force[h].norm());
              identity.add_force(carriers.half_force[h], from);
              identity.add_force(-carriers.half_force[h], to);
            }
        }
      if (judged)
        sums.nodal_residual = identity.residual();
      const double size  = std::accumulate(carriers.half_size.begin(), carriers.half_size.end(), 0.);
      sums.outside_share = size > 0 ? outside / size : 0;
    }
  } // namespace

  CellSums average_by_segments(const TargetCells &target, const Carriers &carriers)
  {
    CellSums sums = zero_sums(target, carriers);
    if (carriers.of_grains.cols() > 0 || carriers.count_joined)
      {
        const GrainShares shares = disc_shares(target, carriers);
        for (std::size_t i = 0; i < carriers.position.size(); ++i)
          for (std::size_t k = shares.begin[i]; k < shares.begin[i + 1]; ++k)
            if (carriers.of_grains.cols() > 0)
              sums.of_grains.row(shares.cell[k]) += shares.share[k] * carriers.of_grains.row(Eigen::Index(i));
        sums.joined = joined_grains(target, carriers, shares);
      }
    cut_halves(target, carriers, sums);
    return sums;
  }
} // namespace diptych::coupling
