// diptych: averaging by segments: branches and discs are cut at the cells' edges
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <cmath>
#include <numeric>

#include "coupling/averaging/averaging_methods.h"
#include "coupling/averaging/collar.h"
#include "coupling/averaging/disc_part.h"
#include "coupling/averaging/segments.h"

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

    // Exact areas of the discs in the cells. The part outside the mesh goes to the boundary cell nearest to that part's
    // centroid. The inside parts give this centroid, because the first moments of both parts about the centre add up to zero.
    // Images of a mesh wider than the period overlap. Shares of a disc that lies in them twice are scaled to one.
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
                continue; // the disc and the polygon are apart, and the sectors cancel
              inside.area += part.area;
              inside.moment += part.moment;
              shares.add(cell % target.n_cells(), part.area / full);
            }
          const double rest = full - inside.area;
          if (rest > 1e-12 * full)
            shares.add(target.cell_of(target.search.locate(x - inside.moment / rest).triangle), rest / full);
          else if (rest < -1e-12 * full)
            shares.scale_row(full / inside.area);
          shares.end_row(false);
        }
      return shares;
    }

    // Part of a tapered quantity between the parameters from and to: integral of 2 (1 - t).
    double tapered_share(const double from, const double to)
    {
      return (to - from) * (2 - to - from);
    }

    // The mesh with a collar that holds all half branches, so that boundary cells receive the same as from map_grains().
    CollaredMesh ground_of_halves(const TargetCells &target, const Carriers &carriers)
    {
      std::vector<Eigen::Vector2d> ends;
      for (const HalfBranch &half : carriers.half)
        {
          ends.push_back(carriers.position[half.grain]);
          ends.push_back(ends.back() + half.vector);
        }
      return ground_of(target.mesh, target.period, ends);
    }

    // Both sides of the nodal identities of the half branches' forces and couples (README.md). They are summed while the half
    // branches are cut. `moment_sides` has one vector per node; its components are the two sides of the balance of moment.
    class NodalIdentity
    {
    public:
      NodalIdentity(const CollaredMesh &ground, const TriangleSearch &search)
          : ground(ground),
            search(search),
            force_side(ground.mesh.node.size(), Eigen::Vector2d::Zero()),
            moment_sides(force_side)
      {
        mapped.triangle_moment.assign(ground.mesh.triangle.size(), Eigen::Matrix2d::Zero());
      }

      void add(const Carriers                           &carriers,
               const Eigen::Index                        row,
               const Eigen::Vector2d                    &from,
               const std::vector<TriangleSearch::Piece> &pieces)
      {
        const auto            m     = carriers.uniform.row(row);
        const Eigen::Vector2d along = carriers.half[std::size_t(row)].vector, to = from + along;
        Eigen::Matrix2d       moment;
        moment << m[0], m[1], m[2], m[3];
        if (moment.isZero(0))
          return;
        const Eigen::Vector2d force     = -moment * along / along.squaredNorm();
        const double          turn      = along.x() * force.y() - along.y() * force.x(),
                     couple             = -m.segment<2>(couple_moment).dot(along) / along.squaredNorm();
        const Eigen::RowVector2d spread = m.segment<2>(couple_moment), tapered = carriers.tapered.row(row).head<2>();
        for (const TriangleSearch::Piece &piece : pieces)
          {
            const double share = piece.to - piece.from;
            mapped.triangle_moment[piece.triangle] += share * moment;
            has_left = has_left || !piece.inside;

            const auto            node     = triangle_nodes(ground.mesh, piece.triangle);
            const auto            gradient = shape_gradients(ground.mesh, piece.triangle);
            const Eigen::Vector2d middle   = from + 0.5 * (piece.from + piece.to) * along;
            const Eigen::Vector3d value    = shape_values(ground.mesh, piece.triangle, middle);
            const Eigen::Vector2d part     = (share * spread + tapered_share(piece.from, piece.to) * tapered).transpose();
            for (unsigned int k = 0; k < 3; ++k)
              moment_sides[node[k]] += Eigen::Vector2d(part.dot(gradient.col(k)) + value[k] * share * turn, 0);
          }
        largest_force = std::max(largest_force, force.norm());
        longest       = std::max(longest, along.norm());
        add_at_nodes(ground.mesh, search, force, from, force_side);
        add_at_nodes(ground.mesh, search, -force, to, force_side);
        add_at_nodes(ground.mesh, search, {0, turn + couple}, from, moment_sides);
        add_at_nodes(ground.mesh, search, {0, -couple}, to, moment_sides);
      }

      bool   is_known() const { return !has_left && ground.is_closed && largest_force > 0; }
      double residual() const
      {
        return is_known() ? largest_difference(ground, nodal_forces(ground.mesh, mapped), force_side) / largest_force : NAN;
      }
      double couple_residual() const
      {
        std::vector<Eigen::Vector2d> left, right;
        for (const Eigen::Vector2d &sides : moment_sides)
          {
            left.emplace_back(sides.x(), 0);
            right.emplace_back(sides.y(), 0);
          }
        return is_known() ? largest_difference(ground, left, right) / (largest_force * longest) : NAN;
      }

    private:
      const CollaredMesh          &ground;
      const TriangleSearch        &search;
      MappedMoment                 mapped;
      std::vector<Eigen::Vector2d> force_side, moment_sides;
      double                       largest_force = 0, longest = 0;
      bool                         has_left = false; // a half branch lay beyond the collar
    };

    void cut_halves(const TargetCells &target, const Carriers &carriers, CellSums &sums)
    {
      const bool                         uniform = carriers.uniform.cols() > 0, tapered = carriers.tapered.cols() > 0;
      double                             outside = 0;
      const CollaredMesh                 ground  = ground_of_halves(target, carriers);
      const TriangleSearch               search(ground.mesh);
      NodalIdentity                      identity(ground, search);
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
            }
          if (carriers.judge_nodes)
            identity.add(carriers, row, from, pieces);
        }
      sums.nodal_residual  = identity.residual();
      sums.couple_residual = identity.couple_residual();
      const double size    = std::accumulate(carriers.half_size.begin(), carriers.half_size.end(), 0.);
      sums.outside_share   = size > 0 ? outside / size : 0;
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
